// SPDX-License-Identifier: MIT
// Numbers as a plan's buffers take them.
#pragma once

#include "rebound/plan.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace rebound::runner {

// A copy of a vector, an array or a span of plain numbers.
template <class Numbers>
SharedBytes sharedBytes(const Numbers& numbers) {
    const auto bytes = std::as_bytes(std::span(numbers));
    return std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
}

} // namespace rebound::runner
