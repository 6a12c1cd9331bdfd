// SPDX-License-Identifier: MIT
// Surfels: discs that stand for the sides of a scene's surfaces when they send light.
#pragma once

#include "rebound/bake/bake_scene.hpp"
#include "rebound/bake/geometry.hpp"
#include "rebound/bake/rays.hpp"
#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rebound {

struct Surfel {
    glm::vec3 position{0.0f}; // on the surface [m]
    glm::vec3 normal{0.0f};   // unit, of the surface there, on the side that the surfel is on
    float area = 0.0f;        // of the surface that is nearer to it than to others [m^2]
    glm::vec3 albedo{0.0f};   // mean over that area
    glm::vec3 emission{0.0f}; // likewise; radiance
    // Mean of the directions in which the open is seen, weighted by the cosine to the normal: from where light that comes
    // from far away can reach it. 0: from nowhere; of length 2/3: from the whole half space.
    glm::vec3 open{0.0f};
    glm::vec3 prospect{0.0f}; // mean of the places that are seen from it, weighted likewise [m]
};

// About settings.surfels of them, spread over the sides of all surfaces that anything but back faces can be seen from:
// evenly; sparsely where only the open is seen, as light from there meets nothing again; and densely on small lamps.
// Neighbours in space are neighbours in the list. Areas add up to that of those sides; holes have none. Fewer, or more, where so many cannot
// stand for all surfaces: there is at least one for each side of a box. The same for any number of threads.
// Fails where the geometry or the settings are not valid, no side is left, or memory is short.
Result<std::vector<Surfel>> placeSurfels(const BakeGeometry&, const RayCaster&, const BakeSettings&);

} // namespace rebound
