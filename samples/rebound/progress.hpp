// SPDX-License-Identifier: MIT
// A line on a terminal that says how far a long step is, and how long it still takes.
#pragma once

#include <chrono>
#include <string>

namespace rebound::cli {

// Says nothing in the first second, nor where standard error is not a terminal; its destructor clears the
// line.
class ProgressLine {
public:
    explicit ProgressLine(std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    // What the line says from now on.
    void describe(const std::string& step) { what = step; }
    // And another step begins, of which the time left is told anew.
    void begin(const std::string& step) {
        if (step == what) return;
        what = step;
        beganAt = -1.0;
    }

    // share: what is done, 0 to 1. From any thread, one call at a time.
    void update(double share);

private:
    using Clock = std::chrono::steady_clock;

    std::string timeLeft(double share) const;

    std::string what;
    bool isTerminal;
    Clock::time_point next;  // no line before
    Clock::time_point began; // the first update
    double beganAt = -1.0;   // the share that was done then; below 0: there was none yet
    bool shown = false;
};

} // namespace rebound::cli
