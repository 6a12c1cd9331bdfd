// SPDX-License-Identifier: MIT
// Settings for programs, as every file of results has them.
#pragma once

#include "rebound/techniques/screen_indirect.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace rebound::measure {

// Keeps the order in which keys were added.
using Json = nlohmann::ordered_json;

// As run: the preset's values and those that replaced them.
Json settingsToJson(const ScreenIndirectSettings&, const std::string& preset);

} // namespace rebound::measure
