// SPDX-License-Identifier: MIT
// Bakes in files: little-endian, with a version and a checksum.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/result.hpp"

#include <filesystem>

namespace rebound {

// Written to a temporary name beside it and renamed: there is never half a file of that name.
Result<> writeBake(const Bake&, const std::filesystem::path&);

// The file is mapped into memory, where the system can, and lives as long as a copy of the bake. Fails, in one sentence,
// where it is no bake, of another version, cut short or altered.
Result<Bake> readBake(const std::filesystem::path&);

} // namespace rebound
