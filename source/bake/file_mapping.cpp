// SPDX-License-Identifier: MIT
#include "file_mapping.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <system_error>

#if __has_include(<sys/mman.h>) && __has_include(<unistd.h>)
#define REBOUND_MAPS_FILES
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace rebound::detail {

namespace {

namespace fs = std::filesystem;

Error unreadable(const fs::path& path, const std::string& reason) {
    return {ErrorCode::inputOutput, "cannot read " + path.string() + ": " + reason};
}

#ifdef REBOUND_MAPS_FILES

Result<FileMapping> mapOpenFile(int file, const fs::path& path) {
    struct stat status {};
    if (::fstat(file, &status) != 0) return unreadable(path, std::strerror(errno));
    if (!S_ISREG(status.st_mode)) return unreadable(path, "it is no regular file");
    if (status.st_size == 0) return FileMapping{};
    const size_t size = size_t(status.st_size);
    void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (memory == MAP_FAILED) return unreadable(path, std::strerror(errno));
    std::shared_ptr<const void> storage(static_cast<const void*>(memory),
                                        [memory, size](const void*) { ::munmap(memory, size); });
    return FileMapping{{static_cast<const std::byte*>(memory), size}, std::move(storage)};
}

Result<FileMapping> open(const fs::path& path) {
    const int file =
        ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); // a pipe would wait for its writer
    if (file < 0) return unreadable(path, std::strerror(errno));
    auto mapping = mapOpenFile(file, path);
    ::close(file);
    return mapping;
}

#else

Result<FileMapping> open(const fs::path& path) {
    std::error_code failure;
    if (!fs::is_regular_file(path, failure))
        return unreadable(path, failure ? failure.message() : "it is no regular file");
    const size_t size = size_t(fs::file_size(path, failure));
    if (failure) return unreadable(path, failure.message());
    std::FILE* const stream = std::fopen(path.string().c_str(), "rb");
    if (!stream) return unreadable(path, std::strerror(errno));
    // Words: sections are aligned to them.
    std::shared_ptr<uint64_t[]> storage(new (std::nothrow) uint64_t[size / 8 + 1]);
    const bool complete = storage && std::fread(storage.get(), 1, size, stream) == size;
    std::fclose(stream);
    if (!storage)
        return Error{ErrorCode::outOfMemory,
                     path.string() + " takes " + std::to_string(size) + " bytes; memory is short"};
    if (!complete) return unreadable(path, "it ended early");
    const auto* const bytes = reinterpret_cast<const std::byte*>(storage.get());
    return FileMapping{{bytes, size}, std::move(storage)};
}

#endif

} // namespace

Result<FileMapping> mapFile(const fs::path& path) { return open(path); }

} // namespace rebound::detail
