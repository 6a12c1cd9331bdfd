// SPDX-License-Identifier: MIT
// A triangle of the geometry that is baked.
#pragma once

#include "rebound/bake/geometry.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace rebound::detail {

// In double precision, the cross product of edges of 1e-6 m or 1e5 m neither vanishes nor overflows.
struct Triangle {
    std::array<glm::dvec3, 3> corner; // [m]

    Triangle(const BakeGeometry& geometry, uint32_t index) {
        for (size_t i = 0; i < 3; ++i)
            corner[i] = glm::dvec3(geometry.positions[geometry.indices[size_t(index) * 3 + i]]);
    }

    // Its length is twice the area; it points to where corners are seen counter-clockwise.
    glm::dvec3 cross() const { return glm::cross(corner[1] - corner[0], corner[2] - corner[0]); }
    double area() const { return 0.5 * glm::length(cross()); } // [m^2]
    // Unit; precondition: the area is not zero.
    glm::dvec3 normal() const { return glm::normalize(cross()); }
    glm::dvec3 at(glm::dvec2 barycentrics) const {
        return corner[0] + (corner[1] - corner[0]) * barycentrics.x +
               (corner[2] - corner[0]) * barycentrics.y;
    }
};

// How far off a surface a ray starts, along the normal, to miss it: a few units in the last place of the largest of
// coordinates and extents that it was computed from, which is what rounding may put a point off by [m].
inline float clearance(float largest) { return 6.0f * std::numeric_limits<float>::epsilon() * largest; }

inline float clearance(const BakeGeometry& geometry, uint32_t index, glm::vec3 position) {
    const glm::vec3 size = glm::abs(position);
    float largest = std::max({size.x, size.y, size.z});
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec3 off =
            glm::abs(geometry.positions[geometry.indices[size_t(index) * 3 + i]] - position);
        largest = std::max({largest, off.x, off.y, off.z});
    }
    return clearance(largest);
}

} // namespace rebound::detail
