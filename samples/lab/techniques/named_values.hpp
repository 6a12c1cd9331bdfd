// SPDX-License-Identifier: MIT
// Options and keys whose value is one of a few names.
#pragma once

#include "rebound/result.hpp"

#include <span>
#include <string>
#include <utility>

namespace rebound::techniques {

template <class T>
using Names = std::span<const std::pair<const char*, T>>;

inline Error unexpected(const std::string& option, const std::string& value, const std::string& expected) {
    return invalidArgument(option + " is \"" + value + "\"; " + expected + " was expected");
}

template <class T>
Result<T> valueNamed(const std::string& option, const std::string& wanted, Names<T> names) {
    std::string known;
    for (const auto& [name, value] : names) {
        if (wanted == name) return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    return unexpected(option, wanted, "one of " + known);
}

template <class T>
const char* nameIn(Names<T> names, T wanted) {
    for (const auto& [name, value] : names)
        if (value == wanted) return name;
    return "?";
}

} // namespace rebound::techniques
