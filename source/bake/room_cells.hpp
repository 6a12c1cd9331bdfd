// SPDX-License-Identifier: MIT
// Large cells for the free space between surfaces, which only objects that move pass through.
#pragma once

#include "cache_places.hpp"
#include "facing.hpp"
#include "grid_cells.hpp"

#include <cstdint>
#include <vector>

namespace rebound::detail {

// Cubes of 4, 8 or 16 cells that fill the lattice, as small as so many corners allow. Without any where that is too few.
void addRooms(GridCells&, size_t mostCorners);

// Of each room, by bit, which corners' caches are in sight of its free space: those behind a wall light nobody in it.
std::vector<uint8_t> cornersInSight(const Surroundings&, const GridCells&, const std::vector<CachePlace>&,
                                    int threads);

} // namespace rebound::detail
