// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace rebound::cli {

ProgressLine::ProgressLine(std::string step)
    : what(std::move(step)), isTerminal(isatty(STDERR_FILENO) == 1),
      next(Clock::now() + std::chrono::seconds(1)) {}

ProgressLine::~ProgressLine() {
    if (shown)
        std::fputs("\r\033[K", stderr);
}

void ProgressLine::update(double share) {
    if (!isTerminal || Clock::now() < next)
        return;
    next = Clock::now() + std::chrono::milliseconds(200);
    shown = true;
    std::fprintf(stderr, "\r\033[K%s: %.0f %%", what.c_str(), share * 100.0);
    std::fflush(stderr);
}

} // namespace rebound::cli
