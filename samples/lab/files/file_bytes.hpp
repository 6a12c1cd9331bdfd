// SPDX-License-Identifier: MIT
// Whole files in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace rebound::lab {

// Reads a regular file of at most `limit` bytes. Throws InputError: the message names this file only if it is
// not `owner`, the file that guardInput already names.
std::vector<uint8_t> readFileBytes(const std::filesystem::path& file, size_t limit,
                                   const std::filesystem::path& owner);

} // namespace rebound::lab
