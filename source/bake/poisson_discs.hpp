// SPDX-License-Identifier: MIT
// A choice of points on surfaces, none too near to another, and which of them is nearest.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rebound::detail {

// A point of one side of a surface.
struct SidePoint {
    glm::vec3 position{0.0f}; // [m]
    glm::vec3 normal{0.0f};   // unit
};

// Squared distance along surfaces, as far as two points can tell: as the crow flies, and as much as the radius more where
// normals are at right angles. Sides of a wall, whose normals are opposite, are never within a radius of each other.
inline float surfaceDistance2(const SidePoint& a, const SidePoint& b, float radius) {
    const glm::vec3 off = a.position - b.position;
    return glm::dot(off, off) + radius * radius * (1.0f - glm::dot(a.normal, b.normal));
}

struct PoissonDiscs {
    float radius = 0.0f;          // of discs; no two chosen points are nearer to each other than this [m]
    std::vector<uint32_t> chosen; // points
    std::vector<uint32_t>
        nearest; // of each point: the index in `chosen` of the nearest, which is within the radius
};

// About `count` of the points, which stand for `area` together, so that every point is within the radius of one. More
// than a twentieth more or fewer only where no radius gives that many. The same for any number of threads.
// Precondition: there are points.
PoissonDiscs choosePoissonDiscs(std::span<const SidePoint>, double area, double count, uint64_t seed,
                                int threads);

} // namespace rebound::detail
