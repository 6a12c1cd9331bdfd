// SPDX-License-Identifier: MIT
// Settings of a bake as people write them.
#pragma once

#include "lab/techniques/technique.hpp"
#include "rebound/bake/bake_scene.hpp"

namespace rebound::techniques {

// Options of a draft that say how to bake.
std::vector<Option> bakeOptions();

// Fails where a value is none of an option's, or out of range; the error names the option. Options of others are not
// looked at.
Result<BakeSettings> bakeSettingsOf(const Draft&, Spelling);

Json toJson(const BakeSettings&);

// In few words: equal where, and only where, they bake the same.
std::string nameOf(const BakeSettings&);

} // namespace rebound::techniques
