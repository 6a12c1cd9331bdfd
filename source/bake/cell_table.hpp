// SPDX-License-Identifier: MIT
// Cells with their caches, and the tables in which run time finds them.
#pragma once

#include "cache_places.hpp"
#include "grid_cells.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rebound::detail {

inline constexpr uint32_t noCache = 0xffffffffu;

struct Cell {
    LatticeKey key = 0;
    std::array<uint32_t, 8> caches{}; // at its corners, x fastest; noCache: none
};

struct CellTable {
    std::vector<glm::vec3> caches; // positions of those that take part [m]
    std::vector<Cell> cells;       // those that have one, ascending keys
    glm::uvec3 bricks{1};
    uint32_t filledBricks = 0;
    std::vector<uint32_t> brickOf; // section bricks of a bake
    std::vector<uint32_t> cellOf;  // section brickCells of a bake
};

CellTable tabulateCells(const GridCells&, const std::vector<CachePlace>&, const std::vector<LostCell>& = {});

} // namespace rebound::detail
