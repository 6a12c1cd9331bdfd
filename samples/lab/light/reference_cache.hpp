// SPDX-License-Identifier: MIT
// Path-traced light, computed once and kept in a folder under the hash of what it depends on.
#pragma once

#include "lab/light/path_tracer.hpp"

#include <filesystem>

namespace rebound::lab {

// What tracePaths() returns, or better: <folder>/<pathTracerKey>.paths keeps what was traced, and is taken up
// where it has not enough samples; what another path tracer has left is not. It is written after every pass, so that an interruption loses little. The
// folder is created where it is missing; a damaged file is traced anew.
Result<PathTracedLight> cachedReference(const Scene&, const CameraView&, const PathTracerOptions&,
                                        const std::filesystem::path& folder);

} // namespace rebound::lab
