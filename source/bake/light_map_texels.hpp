// SPDX-License-Identifier: MIT
// A chart in texels, and which place of its surface each stands for.
#pragma once

#include "light_map_charts.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rebound::detail {

struct TexelPlace {
    glm::ivec2 at{0}; // of the chart's texels
    glm::vec3 position{
        0.0f}; // on the surface [m]: in the texel's middle, or where the surface comes nearest to it
    glm::vec3 normal{0.0f}; // unit, of the triangle's front
};

// With a texel on each side that the chart does not reach: what is read between texels never leaves these.
struct ChartTexels {
    glm::ivec2 size{0};           // [texels]
    glm::dvec2 origin{0.0};       // of its texels, in the chart's frame [texels]
    std::vector<TexelPlace> held; // those that hold a piece of the chart, row by row
};

ChartTexels texelsOf(const BakeGeometry&, const Chart&);

} // namespace rebound::detail
