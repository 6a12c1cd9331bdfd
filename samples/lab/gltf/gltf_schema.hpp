// SPDX-License-Identifier: MIT
// Which keys of a glTF file's JSON have to be there, and of which type.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace rebound::lab {

// Checks what the lab reads against glTF 2.0's schema and that of KHR_lights_punctual, but for indices, which
// checkGltfStructure() checks wherever they are. The error names the key by its path. Throws InputError.
void checkGltfSchema(const nlohmann::json& root);

} // namespace rebound::lab
