// SPDX-License-Identifier: MIT
// From which side surfaces are seen, and which sides light can reach.
#pragma once

#include "rebound/bake/geometry.hpp"
#include "rebound/bake/rays.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rebound::detail {

// What is asked of the geometry again and again.
struct Surroundings {
    const BakeGeometry& geometry;
    const RayCaster& rays;
    float clearance; // rays that start this far off a surface miss it [m]

    Surroundings(const BakeGeometry&, const RayCaster&);
    // Unit, towards the side from which corners are seen counter-clockwise.
    glm::vec3 normalOf(uint32_t triangle) const;
};

// Directions spread evenly over the sphere, the same each time.
// Marques et al.: Spherical Fibonacci Point Sets for Illumination Integrals, 2013.
std::vector<glm::vec3> sphereDirections(uint32_t count);

// A place on one side of a surface.
struct SurfaceSide {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0, 1, 0}; // unit, out of this side
};

// How many of these back sides see hardly any front face. Those that do are right to be seen: the back of a curtain, say.
size_t countInnerSides(const Surroundings&, std::span<const SurfaceSide>);

} // namespace rebound::detail
