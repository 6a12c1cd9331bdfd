// SPDX-License-Identifier: MIT
// The static geometry that is baked.
#pragma once

#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace rebound {

// What a place on a surface is made of. Both sides reflect and emit alike.
struct BakeSurface {
    glm::vec3 albedo{0.0f};   // diffuse reflectance, 0 to 1
    glm::vec3 emission{0.0f}; // radiance [W m^-2 sr^-1, or any unit of radiance]
    bool hole = false;        // cut out: neither seen nor lit
};

// Triangles in world space, front faces counter-clockwise; where a mesh has none, its back faces are never to be seen.
struct BakeGeometry {
    std::vector<glm::vec3> positions; // [m]
    std::vector<uint32_t> indices;    // three a triangle
    // At barycentric weights of the second and third corner. Called by many threads at a time. Empty: white everywhere.
    std::function<BakeSurface(uint32_t triangle, glm::vec2 barycentrics)> surface;
    // Whether a triangle may have holes: ray casters ask `surface` wherever a ray meets one that may. Empty: each may.
    std::function<bool(uint32_t triangle)> mayHaveHoles;

    uint32_t triangles() const { return uint32_t(indices.size() / 3); }
};

// Fails where an index is out of range, a position is not finite, nothing has an area, or its size is not one that
// single precision and a grid can hold (a diagonal of 1 mm to 100 km, no further from the origin than 1000 of them);
// names which and what was expected.
Result<> validate(const BakeGeometry&);

// Of positions and indices, XXH3 of 128 bits: tells whether a bake is that of a scene. What surfaces are made of is not in
// it.
std::array<uint32_t, 4> fingerprintOf(const BakeGeometry&);

} // namespace rebound
