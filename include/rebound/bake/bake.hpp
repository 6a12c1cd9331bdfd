// SPDX-License-Identifier: MIT
// What is known of a static scene before any light is: surfels that send light, a tree of them, caches that receive it,
// and the links between. Jendersie, Kuri, Grosch: Precomputed Illuminance Composition for Real-Time Global Illumination.
#pragma once

#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace rebound {

// How a link tells from where its sender's light comes.
enum class LinkForm : uint32_t {
    coefficients, // spherical harmonics of what the cache sees of the sender
    direction,    // its mean direction, projected to spherical harmonics at run time   [PIC, sec. 4.6]
};

// Nodes that are summed up together: each is the sum of nodes of earlier stages, or of surfels.
struct BakeStage {
    uint32_t firstNode = 0;
    uint32_t nodes = 0;     // that follow it
    uint32_t terms = 0;     // of each, 2 to 8; short sums are filled up with the empty node
    uint32_t firstTerm = 0; // index into section terms
};
inline constexpr int maximumBakeStages = 64;

// Numbers that tell how large a bake's sections are; all that planning has to know.
struct BakeLayout {
    uint32_t surfels = 0; // at least 1; nodes 0 to surfels - 1
    uint32_t nodes =
        0; // surfels and what sums them up, at most 2 * surfels - 1; node number `nodes` is the empty
           // one, which sends nothing
    uint32_t stages = 0;
    std::array<BakeStage, maximumBakeStages> stage{};
    uint32_t caches = 0; // at least 1
    uint32_t links = 0;  // of each cache, 1 to 4096
    uint32_t bands = 3;  // of spherical harmonics, 2 to 4: bands^2 coefficients a colour
    LinkForm linkForm = LinkForm::coefficients;
    // The grid: cells of spacing^3, in bricks of 4 x 4 x 4 of them.
    glm::vec3 origin{0.0f};    // the grid's lowest corner [m]
    float spacing = 1.0f;      // [m]
    glm::uvec3 bricks{1};      // of the grid, along each axis
    uint32_t filledBricks = 0; // that hold a cell
    uint32_t cells = 0;        // that caches light; at least 1
    uint32_t receivers = 0;
    std::array<uint32_t, 4> geometry{}; // fingerprintOf() the geometry that was baked
    // The light map: caches on surfaces, one a texel, or one for several.
    uint32_t surfaceCaches = 0; // the last ones of all caches; 0: there is no map
    glm::uvec2 mapSize{0};      // [texels], at most 2046 x 4092
    uint32_t mapBackRow =
        0; // rows from a texel of a front side to that of its back; 0: no back side is in the map
    uint32_t mapTriangles = 0; // all of the geometry
    float mapTexel = 0.0f;     // width of texels where surfaces are seen all around; wider elsewhere [m]

    uint32_t coefficients() const { return bands * bands; }
    // Numbers from one kind of a surfel's, a cache's or a stage's numbers to the next: whole groups of items.
    static constexpr uint32_t stride(uint32_t count) { return (count + 63u) / 64u * 64u; }
    // Where a cache's number of that kind lies, one of so many; of links, and of words of their shapes.
    static constexpr size_t ofCache(size_t cache, size_t kind, size_t kinds) {
        return (cache / 16 * kinds + kind) * 16 + cache % 16;
    }
    // Caches of the grid, the first ones.
    uint32_t gridCaches() const { return caches - surfaceCaches; }
    static constexpr uint32_t mapStepsOfTexel = 32;     // of coordinates in section mapCorners
    static constexpr uint32_t noMapCache = 0xffffffu;   // of a texel, in its lower 24 bits
    static constexpr uint32_t noMapTexel = 0xffffffffu; // of a texel that no side of a chart has
    static constexpr uint32_t notInMap = 0xffffffffu;   // of a corner
    // 32-bit numbers in which a link keeps the coefficients above the first.
    uint32_t shapeWords() const {
        if (linkForm == LinkForm::direction) return 1;
        return bands == 2 ? 1 : bands == 3 ? 2 : 4;
    }
};

// Sections are arrays of 32-bit numbers, uploaded as they are. "[k][i]": number k of item i lies at k * stride + i.
enum class BakeSection {
    // [7][surfel], as bits: position x, y, z (float) [m], normal (two signed 16-bit numbers, octahedral; x low), area
    // (float) [m^2], albedo (10 bits each; red low), emission (9 bits each and a common exponent of 5 bits, as
    // GL_RGB9_E5: red low) [W m^-2 sr^-1]. Surfels lie in the order of the tree's leaves.
    surfels,
    // Per stage, from its firstTerm on, [terms][node of the stage], stride(nodes): numbers of nodes.
    terms,
    // [cache / 16][links][cache % 16], so that kernels read one number behind the other; BakeLayout::ofCache(). The sending
    // node; the empty node where a cache has fewer links.
    linkNodes,
    // As linkNodes, float: coefficient 0 of the integral of y_i over the directions in which the cache sees the
    // sender, over the sender's area [m^-2]. Zero where it sees nothing of it.
    linkFactors,
    // [cache / 16][links * shapeWords][cache % 16], word w of link j at j * shapeWords + w. Coefficients form: coefficient i >= 1
    // over coefficient 0 and sqrt(2 l + 1), its largest possible magnitude, l its band, as a signed number of 10 bits
    // (bands 2: three in a word) or of 8 bits (bands 3 and 4: four in a word); lowest bits first. Direction form: a unit
    // vector from the cache to the sender, two signed 16-bit numbers, octahedral; x low.
    linkShapes,
    // [cache], 4 floats each, one behind the other: position [m], and 0.
    places,
    // By brick, x fastest: number of the filled brick whose cells are in effect there (its own, or those of a filled one
    // nearby).
    bricks,
    // By filled brick, 64 each, x fastest: number of the cell in effect there: that cell itself where it is lit, or a lit
    // one near it.
    brickCells,
    // 12 each, one behind the other: caches at its corners, x fastest (0xffffffff: none); its own place in the grid (10
    // bits an axis, x low); its first receiver; how many receivers; 0.
    cells,
    // 4 each, one behind the other: position within its cell (10 bits an axis, of -1 to 2 cells; x low), normal
    // (octahedral, as above), and which share of the cell's eight caches it sees, 8 bits each, corner 0 lowest (2).
    receivers,
    // [mapSize.y][mapSize.x]. Lower 24 bits: number of the texel's cache; noMapCache: nothing arrives there. Upper 8: how
    // it came to it: 0: stands in its middle; 1: elsewhere in it, as the middle lies behind or inside of something; 2: where
    // the surface goes on beyond the chart; 3: is that of the nearest texel that has one; 4: has none.
    mapTexels,
    // [triangle][corner]: where it lies in the map, as a front side; x in the lower 16 bits, y in the upper ones, each in
    // steps of 1 / mapStepsOfTexel texel. notInMap in all three corners: the triangle is lit by the grid.
    mapCorners,
};
inline constexpr int bakeSectionCount = 12;
const char* name(BakeSection);

// 32-bit numbers of a section.
size_t sizeOf(const BakeLayout&, BakeSection);

// That counts are in range. Fails with a sentence that names the one that is not.
Result<> validate(const BakeLayout&);

struct Bake {
    BakeLayout layout;
    std::array<std::span<const uint32_t>, bakeSectionCount> sections; // into storage
    std::shared_ptr<const void> storage;

    std::span<const uint32_t> section(BakeSection s) const { return sections[size_t(s)]; }
};

// That counts are in range, sections have their sizes, and every number that another section, or this one, is indexed
// with lies inside: a kernel that runs over a valid bake reads nothing outside. Fails with a sentence that names what is
// wrong.
Result<> validate(const Bake&);

} // namespace rebound

#include "rebound/detail/bake.inl"
