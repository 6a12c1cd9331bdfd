// SPDX-License-Identifier: MIT
// bakeScene() with what only tests ask for.
#pragma once

#include "light_map_places.hpp"

#include "rebound/bake/bake_scene.hpp"

namespace rebound::detail {

struct BakeExperiments {
    float gridShift = 0.0f; // of the grid along each axis [spacings]
    MapRemedies map;
};

Result<std::optional<Bake>> bakeScene(const BakeGeometry&, const RayCaster&, const BakeSettings&,
                                      const BakeExperiments&, BakeCrew&);

} // namespace rebound::detail
