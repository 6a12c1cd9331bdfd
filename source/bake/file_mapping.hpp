// SPDX-License-Identifier: MIT
// A file's bytes in memory: mapped where the system can, else read.
#pragma once

#include "rebound/result.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

namespace rebound::detail {

struct FileMapping {
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> storage; // that keeps them
};

Result<FileMapping> mapFile(const std::filesystem::path&);

} // namespace rebound::detail
