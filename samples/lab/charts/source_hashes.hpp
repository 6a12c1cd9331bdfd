// SPDX-License-Identifier: MIT
// What results of a chart depend on beside what is measured, as hashes: another text is another measurement.
#pragma once

#include "rebound/plan.hpp"

#include <string>

namespace rebound::charts {

// Of all that a backend (cpu, vulkan or opengl) runs and what runs it: kernels, techniques, the backend, the lab's
// measuring and measures, and the compiler.
std::string sourceHash(const std::string& backend);

// Of the plan's text and all data that it holds.
std::string planHash(const Plan&);

} // namespace rebound::charts
