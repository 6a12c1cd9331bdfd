// SPDX-License-Identifier: MIT
// The grid's place and spacing, and which of its cells hold a surface that light can reach.
#pragma once

#include "facing.hpp"

#include "rebound/bake/bake_scene.hpp"
#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace rebound::detail {

// A cell or a corner of cells, by its place: 10 bits an axis, x low.
using LatticeKey = uint32_t;
inline constexpr uint32_t maximumLatticePlace = 1023;
inline LatticeKey latticeKey(glm::uvec3 place) { return place.x | place.y << 10 | place.z << 20; }
inline glm::uvec3 latticePlace(LatticeKey key) { return {key & 1023u, key >> 10 & 1023u, key >> 20}; }

#include "rebound/math/receiver_offset.h"

struct Lattice {
    glm::vec3 origin{0.0f}; // the lowest corner [m]
    float spacing = 1.0f;   // [m]
    glm::uvec3 cells{1};    // along each axis

    glm::vec3 corner(glm::uvec3 place) const { return origin + spacing * glm::vec3(place); }
    // In cells from the origin.
    glm::vec3 coordinates(glm::vec3 position) const { return (position - origin) / spacing; }
    glm::uvec3 cellAt(glm::vec3 position) const {
        return glm::uvec3(glm::clamp(coordinates(position), glm::vec3(0.0f), glm::vec3(cells) - 1.0f));
    }
    LatticeKey receiverCell(glm::vec3 position, glm::vec3 normal) const {
        return latticeKey(cellAt(position + normal * (receiverOffset * spacing)));
    }
};

// Places where receivers are, spread evenly over the surfaces.
struct ReceivingSides {
    std::vector<SurfaceSide> sides; // from which anything but back faces and the open is seen
    double area = 0.0;              // of these [m^2]
};

ReceivingSides findReceivingSides(const BakeGeometry&, const RayCaster&, const BakeSettings&);

struct GridCells {
    Lattice lattice;
    std::vector<LatticeKey> cells;   // ascending
    std::vector<LatticeKey> corners; // of these cells, ascending

    // Numbers of a cell's corners, x fastest.
    std::array<size_t, 8> cornersOf(LatticeKey cell) const;
};

// With settings.spacing, or else the finest spacing of which settings.caches corners suffice. shift moves the grid by a part
// of its spacing: 0, but in tests of how little it matters. Fails where that spacing asks for more than settings.caches.
Result<GridCells> chooseCells(const BakeGeometry&, const ReceivingSides&, const BakeSettings&,
                              float shift = 0.0f);

} // namespace rebound::detail
