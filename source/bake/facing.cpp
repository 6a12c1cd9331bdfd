// SPDX-License-Identifier: MIT
#include "facing.hpp"

#include "sequence.hpp"
#include "triangle.hpp"

#include <cmath>

namespace rebound::detail {

namespace {

constexpr uint32_t raysOfSide = 16;
constexpr uint32_t fewestFronts =
    4; // of these rays; a few find their way out of an object that is not closed

} // namespace

Surroundings::Surroundings(const BakeGeometry& g, const RayCaster& r)
    : geometry(g), rays(r), clearance(0.0f) {
    glm::vec3 lower(std::numeric_limits<float>::infinity()), upper = -lower;
    for (const uint32_t index : g.indices) {
        lower = glm::min(lower, g.positions[index]);
        upper = glm::max(upper, g.positions[index]);
    }
    // A few hundred times what single precision rounds places of the scene by.
    const float furthest = glm::length(glm::max(glm::abs(lower), glm::abs(upper)));
    clearance = std::max(1e-5f * glm::length(upper - lower), 1e-6f * furthest);
}

glm::vec3 Surroundings::normalOf(uint32_t triangle) const {
    return glm::vec3(Triangle(geometry, triangle).normal());
}

std::vector<glm::vec3> sphereDirections(uint32_t count) {
    constexpr double goldenAngle = 2.39996322972865332;
    std::vector<glm::vec3> directions(count);
    for (uint32_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count, radius = std::sqrt(1.0 - z * z);
        const double angle = std::fmod(goldenAngle * i, 6.283185307179586);
        directions[i] = glm::vec3(glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
    return directions;
}

size_t countInnerSides(const Surroundings& around, std::span<const SurfaceSide> sides) {
    std::vector<BakeRay> rays(sides.size() * raysOfSide);
    std::vector<BakeHit> hits(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        const SurfaceSide& side = sides[i / raysOfSide];
        rays[i].origin = side.position + side.normal * around.clearance;
        rays[i].direction = cosineDirection(side.normal, {halton(i + 1, 2), halton(i + 1, 3)});
    }
    around.rays.intersect(rays, hits);
    size_t inner = 0;
    for (size_t s = 0; s < sides.size(); ++s) {
        uint32_t fronts = 0;
        for (size_t i = s * raysOfSide; i < (s + 1) * raysOfSide; ++i)
            fronts += hits[i].triangle != noTriangle &&
                      glm::dot(around.normalOf(hits[i].triangle), rays[i].direction) < 0.0f;
        inner += fronts < fewestFronts;
    }
    return inner;
}

} // namespace rebound::detail
