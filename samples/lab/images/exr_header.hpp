// SPDX-License-Identifier: MIT
// What an OpenEXR file claims to be, checked before anything of the size it claims is allocated.
#pragma once

#include "rebound/result.hpp"

#include <filesystem>

namespace rebound::lab {

// Expects one flat image within maximumExtent, whose windows overlap, and a file long enough to hold it. May throw what
// OpenEXR throws.
Result<> checkExrHeader(const std::filesystem::path&);

} // namespace rebound::lab
