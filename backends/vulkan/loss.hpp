// SPDX-License-Identifier: MIT
// That the device is lost: one call finds out, all later ones say so.
#pragma once

#include "rebound/result.hpp"

#include <mutex>
#include <optional>
#include <string>

namespace rebound::vulkan {

// For any number of threads.
class Loss {
public:
    // From the loss on, the error of the call that found it.
    Result<> check() const {
        const std::lock_guard lock(mutex);
        if (found) return *found;
        return {};
    }
    // What was being done; the first to find out is remembered.
    Error note(const std::string& what) {
        const std::lock_guard lock(mutex);
        if (!found)
            found = Error{ErrorCode::deviceLost, what + " failed with VK_ERROR_DEVICE_LOST: the device is lost, and what was "
                                                        "made with it can only be destroyed"};
        return *found;
    }

private:
    mutable std::mutex mutex;
    std::optional<Error> found;
};

} // namespace rebound::vulkan
