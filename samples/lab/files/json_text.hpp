// SPDX-License-Identifier: MIT
// JSON from files that nobody vouches for.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace rebound::lab {

// Nested arrays and objects beyond this are refused: copying and printing JSON recurses.
inline constexpr int deepestJson = 64;

// Parses an object. `kind` names in errors what the file should have been, as in "it is not glTF". Throws
// InputError.
nlohmann::json parseJsonObject(std::string_view text, const char* kind);

// A value as it is written, cut where it is long: for errors.
std::string shown(const nlohmann::json&);

} // namespace rebound::lab
