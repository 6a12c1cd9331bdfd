// SPDX-License-Identifier: MIT
// Where the caches of one side of a chart stand, and which texel has which.
#pragma once

#include "facing.hpp"
#include "light_map_texels.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rebound::detail {

// How a texel came to its cache. Numbers of these are kept in bakes.
enum class TexelState : uint8_t {
    own,      // stands in it, where the chart is
    moved,    // stands elsewhere in it, as its middle lies behind or inside of something
    seam,     // stands where the surface goes on beyond the chart
    borrowed, // that of the nearest texel that has one
    dark,     // none: nothing is seen from there that could send light
};

struct MapTexel {
    uint32_t cache = 0; // of the side's; undefined where it is dark
    TexelState state = TexelState::dark;
};

// Before the surface, where rays start.
struct SurfacePlace {
    glm::vec3 position{0.0f}; // [m]
    glm::vec3 normal{0.0f};   // unit, of the surface's side
};

struct ChartSide {
    std::vector<SurfacePlace> caches; // none: the side is never lit
    std::vector<MapTexel> texels; // of the whole chart, row by row; all that may be read between has a state
};

// What tests switch off, to see what it is worth.
struct MapRemedies {
    bool mend = true;  // places behind or inside of something
    bool seams = true; // caches where the surface goes on; else the chart's edge is repeated
};

ChartSide placeOnSide(const Surroundings&, const Chart&, const ChartTexels&, bool front, const MapRemedies&);

} // namespace rebound::detail
