// SPDX-License-Identifier: MIT
// Caches on surfaces, one a texel of a map of them.                                                    [PIC, sec. 4.1]
#pragma once

#include "light_map_places.hpp"

#include "rebound/bake/bake_scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rebound::detail {

struct LightMap {
    glm::uvec2 size{0};               // [texels]; none: no chart is large enough for one
    uint32_t backRow = 0;             // from a texel of a front to that of its back [rows]; 0: no back is lit
    float texel = 0.0f;               // where surfaces are seen all around; wider elsewhere [m]
    std::vector<SurfacePlace> caches; // by chart
    std::vector<uint32_t> texels;     // section mapTexels of a bake, but numbered from these caches' first on
    std::vector<uint32_t> corners;    // section mapCorners of a bake
};

// settings.lightMap caches, about so many; at least one for every chart of some size.
LightMap mapLight(const Surroundings&, const BakeSettings&, const MapRemedies& = {});

} // namespace rebound::detail
