// SPDX-License-Identifier: MIT
// Definitions of bake.hpp that planning needs.

#include <algorithm>
#include <cmath>
#include <string>

namespace rebound {
namespace detail {

inline constexpr uint32_t maximumBakeSurfels = 1u << 20, maximumBakeCaches = 1u << 24,
                          maximumBakeLinks = 4096;
inline constexpr uint32_t maximumMapSide = 2046;   // of fronts; coordinates are kept in 16 bits
inline constexpr uint32_t maximumBakeBricks = 256; // along an axis: 10 bits number the cells

inline Error wrongBake(const std::string& what, const std::string& value, const std::string& expected) {
    return {ErrorCode::invalidData,
            "the bake's " + what + " is " + value + "; " + expected + " was expected"};
}

// Empty where the value lies in the range.
inline std::string outsideRange(uint64_t value, uint64_t first, uint64_t last) {
    if (value >= first && value <= last) return {};
    return std::to_string(first) + " to " + std::to_string(last);
}

struct BakeRange {
    const char* name;
    uint64_t value, first, last;
};

inline Result<> validateCounts(const BakeLayout& l) {
    const uint64_t mostNodes = 2 * uint64_t(l.surfels) - 1;
    for (const BakeRange& r :
         {BakeRange{"number of surfels", l.surfels, 1, maximumBakeSurfels},
          {"number of nodes", l.nodes, l.surfels, mostNodes},
          {"number of stages", l.stages, 0, maximumBakeStages},
          {"number of caches", l.caches, 1, maximumBakeCaches},
          {"number of links a cache", l.links, 1, maximumBakeLinks},
          {"number of bands", l.bands, 2, 4},
          {"form of links", uint64_t(l.linkForm), 0, 1},
          {"number of bricks along x", l.bricks.x, 1, maximumBakeBricks},
          {"number of bricks along y", l.bricks.y, 1, maximumBakeBricks},
          {"number of bricks along z", l.bricks.z, 1, maximumBakeBricks},
          {"number of filled bricks", l.filledBricks, 1, uint64_t(l.bricks.x) * l.bricks.y * l.bricks.z},
          {"number of cells", l.cells, 1, 64 * uint64_t(l.filledBricks)},
          {"number of receivers", l.receivers, 0, 256 * uint64_t(l.cells)}})
        if (const std::string expected = outsideRange(r.value, r.first, r.last); !expected.empty())
            return wrongBake(r.name, std::to_string(r.value), expected);
    return {};
}

inline Result<> validateStages(const BakeLayout& l) {
    uint64_t nodes = l.surfels, terms = 0;
    for (uint32_t s = 0; s < l.stages; ++s) {
        const BakeStage& stage = l.stage[s];
        const std::string name = "stage " + std::to_string(s);
        for (const BakeRange& r : {BakeRange{"'s first node", stage.firstNode, nodes, nodes},
                                   {"'s number of nodes", stage.nodes, 1, l.nodes - nodes},
                                   {"'s number of terms", stage.terms, 2, 8},
                                   {"'s first term", stage.firstTerm, terms, terms}})
            if (const std::string expected = outsideRange(r.value, r.first, r.last); !expected.empty())
                return wrongBake(name + r.name, std::to_string(r.value), expected);
        nodes += stage.nodes;
        terms += uint64_t(stage.terms) * BakeLayout::stride(stage.nodes);
    }
    if (nodes != l.nodes)
        return wrongBake("number of nodes in stages", std::to_string(nodes), std::to_string(l.nodes));
    return {};
}

inline Result<> validateMap(const BakeLayout& l) {
    const uint64_t isThere = l.surfaceCaches > 0 ? 1 : 0, sides = l.mapBackRow > 0 ? 2 : 1;
    for (const BakeRange& r :
         {BakeRange{"number of surface caches", l.surfaceCaches, 0, std::min(l.caches, 0xffffffu) - 1},
          {"light map's width", l.mapSize.x, isThere, isThere * maximumMapSide},
          {"light map's height", l.mapSize.y, isThere * sides, isThere * sides * maximumMapSide},
          {"light map's row of back sides", l.mapBackRow, 0, l.mapSize.y / 2},
          {"number of mapped triangles", l.mapTriangles, isThere, isThere * (0xffffffffu / 3)}})
        if (const std::string expected = outsideRange(r.value, r.first, r.last); !expected.empty())
            return wrongBake(r.name, std::to_string(r.value), expected);
    if (isThere && l.caches > 0xffffffu)
        return wrongBake("number of caches beside a light map", std::to_string(l.caches), "at most 16777215");
    if (!std::isfinite(l.mapTexel) || (l.mapTexel > 0.0f) != isThere)
        return wrongBake("light map's texel", std::to_string(l.mapTexel),
                         "a positive number, or 0 without a map,");
    return {};
}

inline Result<> validatePlace(const BakeLayout& l) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(l.origin[axis])) return wrongBake("origin", "not finite", "a finite position");
    if (!std::isfinite(l.spacing) || l.spacing <= 0.0f)
        return wrongBake("spacing", std::to_string(l.spacing), "a positive number");
    return {};
}

} // namespace detail

inline const char* name(BakeSection section) {
    constexpr const char* names[bakeSectionCount] = {"surfels",    "terms",     "linkNodes", "linkFactors",
                                                     "linkShapes", "places",    "bricks",    "brickCells",
                                                     "cells",      "receivers", "mapTexels", "mapCorners"};
    return names[size_t(section)];
}

inline size_t sizeOf(const BakeLayout& l, BakeSection section) {
    const size_t caches = BakeLayout::stride(l.caches);
    switch (section) {
    case BakeSection::surfels:
        return 7 * size_t(BakeLayout::stride(l.surfels));
    case BakeSection::terms: {
        size_t terms = 0;
        for (uint32_t s = 0; s < std::min(l.stages, uint32_t(maximumBakeStages)); ++s)
            terms += size_t(l.stage[s].terms) * BakeLayout::stride(l.stage[s].nodes);
        return terms;
    }
    case BakeSection::linkNodes:
    case BakeSection::linkFactors:
        return l.links * caches;
    case BakeSection::linkShapes:
        return size_t(l.links) * l.shapeWords() * caches;
    case BakeSection::places:
        return 4 * size_t(l.caches);
    case BakeSection::bricks:
        return size_t(l.bricks.x) * l.bricks.y * l.bricks.z;
    case BakeSection::brickCells:
        return 64 * size_t(l.filledBricks);
    case BakeSection::cells:
        return 12 * size_t(l.cells);
    case BakeSection::receivers:
        return 4 * size_t(l.receivers);
    case BakeSection::mapTexels:
        return size_t(l.mapSize.x) * l.mapSize.y;
    case BakeSection::mapCorners:
        return 3 * size_t(l.mapTriangles);
    }
    return 0;
}

inline Result<> validate(const BakeLayout& layout) {
    if (auto counts = detail::validateCounts(layout); !counts) return counts;
    if (auto stages = detail::validateStages(layout); !stages) return stages;
    if (auto map = detail::validateMap(layout); !map) return map;
    return detail::validatePlace(layout);
}

} // namespace rebound
