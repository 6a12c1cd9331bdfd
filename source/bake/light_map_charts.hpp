// SPDX-License-Identifier: MIT
// Charts of a light map: connected triangles that face alike, seen along one direction.
#pragma once

#include "rebound/bake/geometry.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace rebound::detail {

// A direction and the plane across it, in which a chart is laid flat: light needs neither angles nor areas kept.
struct ChartFrame {
    glm::dvec3 normal{0, 0, 1}; // unit, as are the others; right x up
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    double texel = 1.0; // its width [m]

    glm::dvec2 flat(glm::dvec3 position) const { // [texels]
        return glm::dvec2(glm::dot(right, position), glm::dot(up, position)) / texel;
    }
    double height(glm::dvec3 position) const { return glm::dot(normal, position) / texel; } // [texels]
};

struct Chart {
    ChartFrame frame;
    std::vector<uint32_t> triangles;
    double area = 0.0; // of these [m^2]
};

// Every triangle of an area is in one chart. Where two parts of a chart would lie above each other further apart than
// texels are wide, they are in two. Small charts are joined to those beside. Largest triangles first: theirs are the frames, so that walls lie straight.
std::vector<Chart> growCharts(const BakeGeometry&, double texel);

// Corners as they lie in a chart [texels].
using FlatTriangle = std::array<glm::dvec2, 3>;
FlatTriangle flatTriangle(const BakeGeometry&, const ChartFrame&, uint32_t triangle);

// Barycentric weights of the second and third corner at the place of a triangle that is nearest to a point.
glm::dvec2 nearestOn(const FlatTriangle&, glm::dvec2 point);
glm::dvec2 at(const FlatTriangle&, glm::dvec2 barycentrics);

// Whole texels that a triangle and what lies so near to it may touch: from first to last, both included.
struct TexelRange {
    glm::ivec2 first{0}, last{-1};
};
TexelRange texelsAround(const FlatTriangle&, double margin);

} // namespace rebound::detail
