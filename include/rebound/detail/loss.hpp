// SPDX-License-Identifier: MIT
// That a device is lost: one call finds out, all later ones say so.
#pragma once

#include "rebound/result.hpp"

#include <mutex>
#include <optional>
#include <string>

namespace rebound::detail {

// For any number of threads.
class Loss {
public:
    // From the loss on, what note() gave first.
    Result<> check() const {
        const std::lock_guard lock(mutex);
        if (found) return *found;
        return {};
    }
    // An error with these words, or those of whoever was first.
    Error note(std::string message) {
        const std::lock_guard lock(mutex);
        if (!found) found = Error{ErrorCode::deviceLost, std::move(message)};
        return *found;
    }

private:
    mutable std::mutex mutex;
    std::optional<Error> found;
};

} // namespace rebound::detail
