// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

namespace rebound::lab {

// Of linear Rec. 709.
inline float luminance(glm::vec3 color) { return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z; }

} // namespace rebound::lab
