// SPDX-License-Identifier: MIT
// What static receivers see of the caches of their cell: which of them stand behind a wall.
#pragma once

#include "cell_table.hpp"
#include "facing.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace rebound::detail {

// Surface samples of a cell that lie near each other, face the same way and see the same caches.
struct Receiver {
    glm::vec3 position{0.0f}; // from its cell's lowest corner [cells]
    glm::vec3 normal{0, 1, 0};
    std::array<float, 8> visibility{}; // share of its samples that see a cache
};

// Numbers of the samples in each cell and its margin.
using SamplesOfCells = std::vector<std::vector<uint32_t>>;
SamplesOfCells samplesOfCells(const Lattice&, const std::vector<Cell>&, const std::vector<SurfaceSide>&);

// Of cells first to last - 1, those of each.
std::vector<std::vector<Receiver>> gatherReceivers(const Surroundings&, const Lattice&, const CellTable&,
                                                   const std::vector<SurfaceSide>&, const SamplesOfCells&,
                                                   uint32_t first, uint32_t last);

} // namespace rebound::detail
