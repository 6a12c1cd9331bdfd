// SPDX-License-Identifier: MIT
#include "lab/baking/surfel_lookup.hpp"

#include "lab/light/low_discrepancy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rebound::lab {

namespace {

constexpr float reach = 3.0f; // in radii of a mean surfel

// A cell is as wide as nearest() looks, so that the cells around a place hold all that it may find.
float cellSizeOf(const std::vector<Surfel>& surfels) {
    double area = 0.0;
    for (const Surfel& surfel : surfels) area += double(surfel.area);
    return reach * float(std::sqrt(area / double(surfels.size()) / std::numbers::pi));
}

} // namespace

size_t SurfelLookup::CellHash::operator()(const Cell& cell) const {
    return hashBits(hashBits(uint32_t(cell.x), uint32_t(cell.y)), uint32_t(cell.z));
}

SurfelLookup::SurfelLookup(const Bake& bake) {
    for (uint32_t i = 0; i < bake.layout.surfels; ++i) surfels.push_back(surfelOf(bake, i));
    cellSize = cellSizeOf(surfels);
    for (uint32_t i = 0; i < bake.layout.surfels; ++i) cells[cellOf(surfels[i].position)].push_back(i);
}

SurfelLookup::Cell SurfelLookup::cellOf(glm::vec3 position) const {
    return Cell(glm::floor(position / cellSize));
}

std::optional<uint32_t> SurfelLookup::nearest(glm::vec3 position, glm::vec3 normal) const {
    std::optional<uint32_t> found;
    float least = cellSize * cellSize;
    const Cell middle = cellOf(position);
    for (int i = 0; i < 27; ++i) {
        const auto cell = cells.find(middle + Cell(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
        if (cell == cells.end()) continue;
        for (const uint32_t candidate : cell->second) {
            const glm::vec3 way = surfels[candidate].position - position;
            const float squared = glm::dot(way, way);
            if (squared >= least || glm::dot(surfels[candidate].normal, normal) < 0.3f) continue;
            least = squared;
            found = candidate;
        }
    }
    return found;
}

std::vector<LeafRange> leafRanges(const Bake& bake) {
    const BakeLayout& layout = bake.layout;
    std::vector<LeafRange> ranges(layout.nodes);
    for (uint32_t i = 0; i < layout.surfels; ++i) ranges[i] = {i, i};
    const auto terms = bake.section(BakeSection::terms);
    for (uint32_t s = 0; s < layout.stages; ++s) {
        const BakeStage& stage = layout.stage[s];
        for (uint32_t i = 0; i < stage.nodes; ++i) {
            LeafRange range{layout.nodes, 0};
            for (uint32_t t = 0; t < stage.terms; ++t) {
                const uint32_t term =
                    terms[stage.firstTerm + size_t(t) * BakeLayout::stride(stage.nodes) + i];
                if (term >= layout.nodes) continue;
                range.first = std::min(range.first, ranges[term].first);
                range.last = std::max(range.last, ranges[term].last);
            }
            ranges[stage.firstNode + i] = range;
        }
    }
    return ranges;
}

std::vector<uint32_t> patchesOf(const Bake& bake, const std::vector<LeafRange>& ranges, uint32_t count) {
    // Parents before their children: a child's range lies in its parent's.
    std::vector<uint32_t> order(bake.layout.nodes);
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto sizeOf = [&](uint32_t node) { return ranges[node].last - ranges[node].first; };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return sizeOf(a) != sizeOf(b) ? sizeOf(a) > sizeOf(b) : ranges[a].first < ranges[b].first;
    });
    // Nodes with more surfels first: after `count` patches the largest are split.
    std::vector<uint32_t> patchOf(bake.layout.surfels, bake.layout.nodes);
    uint32_t patches = 0;
    for (const uint32_t node : order) {
        const bool isPart = patchOf[ranges[node].first] < bake.layout.nodes;
        if (isPart && patches >= count) break;
        // Of two children the first takes over its parent's number.
        patches += !isPart || ranges[node].first != ranges[patchOf[ranges[node].first]].first ? 1 : 0;
        for (uint32_t i = ranges[node].first; i <= ranges[node].last; ++i) patchOf[i] = node;
    }
    return patchOf;
}

} // namespace rebound::lab
