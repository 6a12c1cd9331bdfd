// SPDX-License-Identifier: MIT
// Where rectangles lie in a map.
#pragma once

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace rebound::detail {

struct PackedRectangles {
    glm::ivec2 size{0};              // of the map [texels]
    std::vector<glm::ivec2> corners; // the lowest one of each
};

// Without overlap, in a map about as wide as high, of at most so many texels a side; nothing where they do not fit.
std::optional<PackedRectangles> packRectangles(const std::vector<glm::ivec2>& sizes, int most);

} // namespace rebound::detail
