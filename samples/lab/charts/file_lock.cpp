// SPDX-License-Identifier: MIT
#include "lab/charts/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rebound::charts {

Result<FileLock> FileLock::acquire(const std::filesystem::path& path, WhenTaken whenTaken,
                                   const std::string& taken) {
    std::error_code ignored;
    const int flags = std::filesystem::is_directory(path, ignored) ? O_RDONLY : O_RDWR | O_CREAT | O_NOFOLLOW;
    const int descriptor = open(path.c_str(), flags | O_CLOEXEC, 0600);
    if (descriptor < 0)
        return Error{ErrorCode::inputOutput, "cannot open " + path.string() + ": " + std::strerror(errno)};
    FileLock lock(descriptor);
    int failure = 0;
    do failure = flock(descriptor, LOCK_EX | (whenTaken == WhenTaken::fail ? LOCK_NB : 0)) == 0 ? 0 : errno;
    while (failure == EINTR);
    if (failure == EWOULDBLOCK) return Error{ErrorCode::inputOutput, taken};
    if (failure != 0)
        return Error{ErrorCode::inputOutput, "cannot lock " + path.string() + ": " + std::strerror(failure)};
    return lock;
}

FileLock::~FileLock() {
    if (descriptor >= 0) close(descriptor);
}

std::filesystem::path measuringLockFile() {
    return std::filesystem::temp_directory_path() / ("rebound-measuring-" + std::to_string(getuid()));
}

} // namespace rebound::charts
