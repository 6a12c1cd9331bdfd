// SPDX-License-Identifier: MIT
#pragma once

#include "rebound/result.hpp"

#include <stdexcept>
#include <utility>

namespace rebound::accuracy {

// The value; throws what went wrong, for doctest to print.
template <class T>
T take(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
}

} // namespace rebound::accuracy
