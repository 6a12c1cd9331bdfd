// SPDX-License-Identifier: MIT
#pragma once

#include "lab/runner/runner.hpp"

namespace rebound::cli {

// Refuses pictures that this machine's memory cannot hold: where memory is overcommitted, the system would
// end the program without a word.
Result<> checkMemory(Extent2D size, double bytesPerPixel, double furtherBytes = 0.0);

// For running a plan for pictures of that size.
Result<> checkMemory(const runner::Backend&, const Plan& plan, Extent2D size);

} // namespace rebound::cli
