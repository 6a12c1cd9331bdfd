// SPDX-License-Identifier: MIT
// Path-traced light, computed once and kept in a folder under the hash of what it depends on.
#pragma once

#include "lab/path_tracer.hpp"

#include <filesystem>
#include <string>

namespace rebound::lab {

// 32 hexadecimal digits: a hash of everything that path-traced light depends on, but not of samples, error, threads.
std::string referenceKey(const Scene&, const CameraView&, const PathTracerOptions&);

// What tracePaths() returns, from the folder where it holds a result of the same key that is at least as good as the
// options ask for; else traced, from where an earlier run stopped, and stored. The folder is created where it is missing.
Result<PathTracedLight> cachedReference(const Scene&, const CameraView&, const PathTracerOptions&,
                                        const std::filesystem::path& folder);

} // namespace rebound::lab
