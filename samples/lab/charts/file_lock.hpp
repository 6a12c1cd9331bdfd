// SPDX-License-Identifier: MIT
// A file or folder that one process at a time may hold; the system lets go of it when the process ends.
#pragma once

#include "rebound/result.hpp"

#include <filesystem>
#include <string>
#include <utility>

namespace rebound::charts {

class FileLock {
public:
    enum class WhenTaken { fail, wait };

    // Creates a file where there is nothing. Fails where the file cannot be opened, or another process holds it and
    // is not waited for: the message is `taken` then.
    static Result<FileLock> acquire(const std::filesystem::path&, WhenTaken, const std::string& taken = {});

    FileLock(FileLock&& other) noexcept : descriptor(std::exchange(other.descriptor, -1)) {}
    FileLock& operator=(FileLock&& other) noexcept {
        std::swap(descriptor, other.descriptor);
        return *this;
    }
    ~FileLock();

private:
    explicit FileLock(int opened) : descriptor(opened) {}

    int descriptor;
};

// What every measurement on this machine by this user holds while it runs.
std::filesystem::path measuringLockFile();

} // namespace rebound::charts
