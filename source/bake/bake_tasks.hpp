// SPDX-License-Identifier: MIT
// What a bake costs most, as tasks whose parts are done anywhere and put together in their order.
#pragma once

#include "links.hpp"
#include "receivers.hpp"
#include "surfel_lookup.hpp"

#include "rebound/bake/bake_crew.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rebound::detail {

// What a part is of: items number() * size() and following. Whole groups of 64, so that parts of sections lie one behind the
// other; at most 4096 parts, so that their files are not too many for a folder.
class PartRanges {
public:
    explicit PartRanges(size_t items);
    uint32_t parts() const { return (count + size - 1) / size; }
    uint32_t first(uint32_t part) const { return part * size; }
    uint32_t last(uint32_t part) const { return part + 1 < parts() ? (part + 1) * size : count; }

private:
    uint32_t count, size;
};

struct ReceiverSections {
    std::vector<uint32_t> first; // of each cell, and one past the last
    std::vector<uint32_t> words; // section receivers of a bake
};

// What the tasks refer to has to outlive them.
class ReceiverTask {
public:
    ReceiverTask(const Surroundings&, const Lattice&, const CellTable&, const std::vector<SurfaceSide>&,
                 const std::array<uint32_t, 4>& geometry);
    BakeTask task() const;
    ReceiverSections merge(BakeParts&&) const;

private:
    std::vector<uint32_t> run(uint32_t part) const;

    const Surroundings& around;
    const Lattice& lattice;
    const CellTable& table;
    const std::vector<SurfaceSide>& sides;
    const std::array<uint32_t, 4> geometry;
    const SamplesOfCells members;
    const PartRanges ranges;
};

class LinkTask {
public:
    // normals: of the last caches, which lie on surfaces.
    LinkTask(const Surroundings&, std::span<const glm::vec3> caches, std::span<const glm::vec3> normals,
             const SurfelTree&, const BakeSettings&, const std::array<uint32_t, 4>& geometry);
    BakeTask task() const;
    LinkSections merge(BakeParts&&) const;

private:
    std::vector<uint32_t> run(uint32_t part) const;

    const Surroundings& around;
    const std::span<const glm::vec3> caches, normals;
    const SurfelTree& tree;
    const BakeSettings& settings;
    const std::array<uint32_t, 4> geometry;
    const SurfelLookup lookup;
    const PartRanges ranges;
};

} // namespace rebound::detail
