// SPDX-License-Identifier: MIT
// Writing a file whole or not at all.
#pragma once

#include "rebound/result.hpp"

#include <filesystem>
#include <span>

namespace rebound::lab {

// Writes to a temporary name in the same folder and renames it, so that readers see the old content or the
// new, and a failure leaves nothing behind. A link is followed; a device or a pipe is written to directly.
// The folder has to exist. Errors name the file and the system's reason.
Result<> writeFile(const std::filesystem::path&, std::span<const std::byte>);

} // namespace rebound::lab
