// SPDX-License-Identifier: MIT
// Points spread over all surfaces, each standing for an area, and which sides of them can be lit.
#pragma once

#include "rebound/bake/bake_scene.hpp"
#include "rebound/bake/geometry.hpp"
#include "rebound/bake/rays.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rebound::detail {

// What can be seen from a side of a surface, and so where its light goes.
enum class SideView : uint8_t {
    nothing,  // back faces alone, or it is in a hole: it is never lit
    open,     // no front face, but the open: light comes in, and leaves without meeting anything again
    surfaces, // a front face
};

struct SurfaceSample {
    glm::vec3 position{0.0f}; // [m]
    glm::vec3 normal{0.0f};   // of the front
    uint32_t triangle = 0;
    float area = 0.0f; // that it stands for [m^2]
    glm::vec3 albedo{0.0f};
    glm::vec3 emission{0.0f};
    bool isHole = false;
    SideView front = SideView::nothing;
    SideView back = SideView::nothing;
};

// Evenly by area, the same for any number of threads; but at least a share `onEmitters` of them is on triangles that
// emit, if any does, as all light of a scene may come from a small lamp. Precondition: geometry and settings are valid.
std::vector<SurfaceSample> sampleSurfaces(const BakeGeometry&, const RayCaster&, const BakeSettings&,
                                          size_t count, double onEmitters = 0.0);

} // namespace rebound::detail
