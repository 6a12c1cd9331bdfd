// SPDX-License-Identifier: MIT
// The path tracer against an independent renderer's light in real scenes.
#pragma once

#include "reference_frames.hpp"

#include <filesystem>
#include <set>
#include <string>

namespace rebound::accuracy {

// Traces views of <shared>/reference by their names, scene/camera, or all with no name, and fails the test where direct
// light, one bounce or eight are not the reference's. Says so and does nothing where the references are not there.
void checkPathTracer(const std::filesystem::path& shared, const std::set<std::string>& names);

} // namespace rebound::accuracy
