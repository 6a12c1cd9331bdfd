// SPDX-License-Identifier: MIT
#include "lab/files/output_file.hpp"

#include "file_writer.hpp"

namespace rebound::lab {

Result<> writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    return detail::writeFile(path, {&bytes, 1});
}

} // namespace rebound::lab
