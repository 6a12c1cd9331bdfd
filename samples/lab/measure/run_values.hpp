// SPDX-License-Identifier: MIT
// What runs are asked for beside a technique's settings, as people write it.
#pragma once

#include "lab/runner/runner.hpp"

#include <string>

namespace rebound::measure {

// WIDTHxHEIGHT, each 1 to maximumExtent; `what` is what the error calls it.
Result<Extent2D> parseSize(const std::string& what, const std::string& text);

// half or float; `what` is what the error calls it.
Result<runner::Precision> precisionNamed(const std::string& what, const std::string& name);
const char* nameOf(runner::Precision);

} // namespace rebound::measure
