// SPDX-License-Identifier: MIT
#include "file_writer.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

namespace rebound::detail {

namespace {

namespace fs = std::filesystem;
using Pieces = std::span<const std::span<const std::byte>>;

Error unwritable(const fs::path& path, const std::string& reason) {
    return {ErrorCode::inputOutput, "cannot write " + path.string() + ": " + reason};
}

// Closes the stream. Returns 0 or the system's error number; a full disk may show on closing only.
int writeAndClose(std::FILE* stream, Pieces pieces) {
    errno = 0;
    bool written = true;
    for (const auto& piece : pieces)
        written = written && std::fwrite(piece.data(), 1, piece.size(), stream) == piece.size();
    written = written && std::fflush(stream) == 0;
    const int writeError = errno;
    errno = 0;
    const bool closed = std::fclose(stream) == 0;
    if (written && closed) return 0;
    const int reason = written ? errno : writeError;
    return reason == 0 ? EIO : reason;
}

// Opens a file that did not exist before. Null with errno where that fails.
std::FILE* openTemporary(const fs::path& folder, fs::path& temporary) {
    constexpr int attempts =
        1000; // names that other writers in this folder may hold, or have left in a crash
    for (int i = 0; i < attempts; ++i) {
        temporary = folder / (".rebound-" + std::to_string(i) + ".partial");
        if (std::FILE* stream = std::fopen(temporary.string().c_str(), "wbx")) return stream;
        if (errno != EEXIST) return nullptr;
    }
    return nullptr;
}

Result<> writeDirectly(const fs::path& path, Pieces pieces) {
    std::FILE* stream = std::fopen(path.string().c_str(), "wb");
    const int error = stream ? writeAndClose(stream, pieces) : errno;
    if (error != 0) return unwritable(path, std::strerror(error));
    return {};
}

} // namespace

Result<> writeFile(const fs::path& path, Pieces pieces) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (!path.has_filename()) return unwritable(path, "expected a file's name");
    if (fs::is_directory(status)) return unwritable(path, "it is a folder");
    if (fs::exists(status) && !fs::is_regular_file(status)) return writeDirectly(path, pieces);

    std::error_code failure;
    const fs::path target = fs::exists(status) ? fs::canonical(path, failure) : path;
    if (failure) return unwritable(path, failure.message());
    fs::path temporary;
    std::FILE* stream = openTemporary(target.parent_path(), temporary);
    if (!stream) return unwritable(path, std::strerror(errno));
    if (const int error = writeAndClose(stream, pieces)) {
        fs::remove(temporary, ignored);
        return unwritable(path, std::strerror(error));
    }
    fs::rename(temporary, target, failure);
    if (failure) {
        fs::remove(temporary, ignored);
        return unwritable(path, failure.message());
    }
    return {};
}

} // namespace rebound::detail
