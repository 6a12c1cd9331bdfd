// SPDX-License-Identifier: MIT
// Where caches stand: at corners of the lattice, moved out of geometry and away from surfaces.
#pragma once

#include "facing.hpp"
#include "grid_cells.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rebound::detail {

struct CachePlace {
    glm::vec3 position{0.0f}; // [m]
    bool isValid = true;      // false: inside of something, and nowhere near is a place outside
    bool isMoved = false;
};

// One a corner.
std::vector<CachePlace> placeCaches(const Surroundings&, const GridCells&, int threads);

// A cell none of whose corners has a valid cache, as all are inside of walls, and a place for one of its own.
struct LostCell {
    LatticeKey cell = 0;
    glm::vec3 position{0.0f}; // before its surfaces [m]
};

std::vector<LostCell> placeInLostCells(const Surroundings&, const GridCells&, const std::vector<CachePlace>&,
                                       const std::vector<SurfaceSide>&);

} // namespace rebound::detail
