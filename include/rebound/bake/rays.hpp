// SPDX-License-Identifier: MIT
// Rays through the geometry that is baked: an engine's own ray caster, or that of backends/embree.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace rebound {

// Points origin + t * direction, t from minimum to maximum; direction of unit length. [m]
struct BakeRay {
    glm::vec3 origin{0.0f};
    float minimum = 0.0f;
    glm::vec3 direction{0, 0, -1};
    float maximum = std::numeric_limits<float>::infinity();
};

inline constexpr uint32_t noTriangle = 0xffffffffu;

struct BakeHit {
    uint32_t triangle = noTriangle; // of BakeGeometry; noTriangle: nothing is met
    float distance = 0.0f;          // [m]
    glm::vec2 barycentrics{0.0f};   // weights of the second and third corner
};

// Holes are not met. All queries may run in parallel, and give the same answers whatever else runs.
class RayCaster {
public:
    virtual ~RayCaster() = default;
    // The nearest surface of each ray; as many hits as rays.
    virtual void intersect(std::span<const BakeRay>, std::span<BakeHit>) const = 0;
    // For each ray 1 where anything lies on it, else 0.
    virtual void occluded(std::span<const BakeRay>, std::span<uint8_t>) const = 0;
};

} // namespace rebound
