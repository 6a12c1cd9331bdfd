// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace rebound::cli {

ProgressLine::ProgressLine(std::string step)
    : what(std::move(step)), isTerminal(isatty(STDERR_FILENO) == 1),
      next(Clock::now() + std::chrono::seconds(1)) {}

ProgressLine::~ProgressLine() {
    if (shown) std::fputs("\r\033[K", stderr);
}

// Of steps that go on as they began; nothing until that can be told.
std::string ProgressLine::timeLeft(double share) const {
    const double elapsed = std::chrono::duration<double>(Clock::now() - began).count();
    if (elapsed < 2.0 || share - beganAt < 0.01) return "";
    const long seconds = std::lround(elapsed * (1.0 - share) / (share - beganAt));
    char text[48];
    if (seconds < 120) std::snprintf(text, sizeof text, ", %ld s left", seconds);
    else if (seconds < 7200) std::snprintf(text, sizeof text, ", %ld min left", (seconds + 30) / 60);
    else std::snprintf(text, sizeof text, ", %.1f h left", double(seconds) / 3600.0);
    return text;
}

void ProgressLine::update(double share) {
    if (isTerminal && beganAt < 0.0) {
        began = Clock::now();
        beganAt = share;
    }
    if (!isTerminal || Clock::now() < next) return;
    next = Clock::now() + std::chrono::milliseconds(200);
    shown = true;
    std::fprintf(stderr, "\r\033[K%s: %.0f %%%s", what.c_str(), share * 100.0, timeLeft(share).c_str());
    std::fflush(stderr);
}

} // namespace rebound::cli
