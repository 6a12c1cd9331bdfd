// SPDX-License-Identifier: MIT
// Which surfel stands for a place on a surface, and which patches of the tree that surfel is part of.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/read_surfel.hpp"

#include <optional>
#include <unordered_map>
#include <vector>

namespace rebound::lab {

class SurfelLookup {
public:
    explicit SurfelLookup(const Bake&);

    // The nearest on that side of a surface, unless none is within three times the mean surfel's radius.
    std::optional<uint32_t> nearest(glm::vec3 position, glm::vec3 normal) const;

    const std::vector<Surfel>& all() const { return surfels; }

private:
    using Cell = glm::ivec3;
    struct CellHash {
        size_t operator()(const Cell&) const;
    };
    Cell cellOf(glm::vec3 position) const;

    std::vector<Surfel> surfels;
    float cellSize = 1.0f;
    std::unordered_map<Cell, std::vector<uint32_t>, CellHash> cells;
};

// A node of the tree stands for surfels first to last, both included, as surfels lie in the order of the tree's leaves.
struct LeafRange {
    uint32_t first = 0, last = 0;
};

// By node, without the empty one.
std::vector<LeafRange> leafRanges(const Bake&);

// Patches that are all surfels together: from the root on, the one with the most surfels is split until there are so
// many, or nothing is left to split. By surfel, its patch's node.
std::vector<uint32_t> patchesOf(const Bake&, const std::vector<LeafRange>&, uint32_t count);

} // namespace rebound::lab
