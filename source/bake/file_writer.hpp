// SPDX-License-Identifier: MIT
// Files that are there whole or not at all.
#pragma once

#include "rebound/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>

namespace rebound::detail {

// The pieces one behind the other, written to a temporary name beside the file and renamed. What is no regular file, such
// as a device, is written as it is.
Result<> writeFile(const std::filesystem::path&, std::span<const std::span<const std::byte>> pieces);

} // namespace rebound::detail
