// SPDX-License-Identifier: MIT
#include "lab/files/file_bytes.hpp"

#include "lab/files/input_error.hpp"

#include <fstream>

namespace rebound::lab {

std::vector<uint8_t> readFileBytes(const std::filesystem::path& file, size_t limit,
                                   const std::filesystem::path& owner) {
    const std::string subject = file == owner ? "the file" : "its file '" + file.string() + "'";
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status)) refuse(subject + " does not exist", ErrorCode::notFound);
    // Pipes and devices would block or never end.
    if (!std::filesystem::is_regular_file(status))
        refuse(subject + " is not a regular file", ErrorCode::inputOutput);
    const auto size = std::filesystem::file_size(file, failure);
    if (failure) refuse(subject + " cannot be read: " + failure.message(), ErrorCode::inputOutput);
    if (size > limit)
        refuse(subject + " has " + std::to_string(size) + " bytes; at most " + std::to_string(limit) +
               " are read");
    std::ifstream stream(file, std::ios::binary);
    std::vector<uint8_t> bytes(static_cast<size_t>(size));
    if (!stream || !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        refuse(subject + " cannot be read", ErrorCode::inputOutput);
    return bytes;
}

} // namespace rebound::lab
