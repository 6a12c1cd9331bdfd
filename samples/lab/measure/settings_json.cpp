// SPDX-License-Identifier: MIT
#include "lab/measure/settings_json.hpp"

#include "lab/measure/settings_draft.hpp"

namespace rebound::measure {

Json settingsToJson(const ScreenIndirectSettings& s, const std::string& preset) {
    Json json;
    json["preset"] = preset;
    json["start"] = nameOf(s.start);
    json["levels"] = s.levels;
    if (s.samplesPerLevel == wholeRings) json["samples_per_level"] = "all";
    else json["samples_per_level"] = s.samplesPerLevel;
    json["ring_radius_texels"] = s.ringRadius;
    json["reduction"] = nameOf(s.reduction);
    json["form_factor"] = nameOf(s.formFactor);
    json["minimum_cosine"] = s.minimumCosine;
    json["cover_screen"] = s.coverScreen;
    json["smooth"] = s.smooth;
    json["only_level"] = s.onlyLevel ? Json(*s.onlyLevel) : Json(nullptr);
    return json;
}

} // namespace rebound::measure
