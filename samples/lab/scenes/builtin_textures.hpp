// SPDX-License-Identifier: MIT
// Seamless textures computed for scenes made in code.
#pragma once

#include "lab/scenes/scene.hpp"

#include <glm/glm.hpp>

#include <string>

namespace rebound::lab {

// Linear reflectances; textures hold them as sRGB.
struct Stone {
    glm::vec3 light{0.7f};
    glm::vec3 dark{0.5f};
};

// Cloudy stone without joints.
Texture makeStoneTexture(const std::string& name, const Stone&);

// Courses of blocks with mortar between them, each block of its own shade: 4 courses of 2 blocks.
Texture makeMasonryTexture(const std::string& name, const Stone&, const glm::vec3& mortar);

// 4 x 4 tiles of alternating stones with joints.
Texture makeTileTexture(const std::string& name, const Stone& even, const Stone& odd, const glm::vec3& joint);

// Boards along u with joints between them, grained: 6 boards of different shades over v.
Texture makePlankTexture(const std::string& name, const Stone&, const glm::vec3& joint);

// A woven pattern of lozenges within a border.
Texture makeCarpetTexture(const std::string& name, const glm::vec3& ground, const glm::vec3& figure,
                          const glm::vec3& border);

// Stripes along v.
Texture makeStripeTexture(const std::string& name, const glm::vec3& even, const glm::vec3& odd);

} // namespace rebound::lab
