// SPDX-License-Identifier: MIT
// A camera as view files and the meta.json of stored frames spell it.
#pragma once

#include "lab/scenes/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rebound::lab {

// Keys: position, target [m]; optional name, up (0 1 0), near, far [m]; and either vfov_degrees (full
// vertical angle, between 0 and 180) or orthographic_height [m]. The result passes validate(const
// CameraView&). Every error begins with `context`, which names the file and the place in it.
Result<CameraView> cameraFromJson(const nlohmann::json&, const std::string& context);

// The camera in those keys.
nlohmann::json cameraToJson(const CameraView&);

} // namespace rebound::lab
