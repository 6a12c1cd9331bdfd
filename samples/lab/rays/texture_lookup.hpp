// SPDX-License-Identifier: MIT
// Bilinear lookups into the textures of a scene, at full resolution.
#pragma once

#include "lab/scenes/scene.hpp"

namespace rebound::lab {

// Linear colour (sRGB decoded before filtering) and opacity at a texture coordinate; v = 0 is the top row's
// upper edge. A coordinate that is not finite reads as 0. Precondition: the texture's size is positive and
// matches its data.
glm::vec4 sampleTexture(const Texture&, glm::vec2 coordinate);

// Only the opacity of the above, for cut-outs.
float sampleOpacity(const Texture&, glm::vec2 coordinate);

// The largest linear value that each colour channel of a texture takes.
glm::vec3 largestColor(const Texture&);

} // namespace rebound::lab
