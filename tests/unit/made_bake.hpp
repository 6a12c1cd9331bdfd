// SPDX-License-Identifier: MIT
// Bakes made by hand: a whole grid of cells, surfels in a tree of sums, links as a test wants them.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/packing.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace rebound::test {

inline uint32_t bitsOf(float x) {
    uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}
inline float floatOf(uint32_t bits) {
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

struct MadeSurfel {
    glm::vec3 position{0.0f}, normal{0.0f, 0.0f, 1.0f};
    float area = 1.0f;
    glm::vec3 albedo{0.0f}, emission{0.0f};
};

struct MadeLink {
    uint32_t node = 0;
    float factor = 0.0f;          // coefficient 0
    std::array<int, 16> shape{};  // coefficients form: what is stored for coefficients 1 to 15
    glm::vec3 direction{0, 0, 1}; // direction form
};

struct MadeCache {
    glm::vec3 place{0.0f};
    std::vector<MadeLink> links;
};

struct MadeReceiver {
    glm::vec3 within{0.0f}, normal{0.0f, 0.0f, 1.0f}; // [cells from the cell's lowest corner]
    std::array<int, 8> shares{};                      // 0 to 255, by corner
};

struct MadeCell {
    std::array<uint32_t, 8> caches{};
    glm::uvec3 place{0};
    std::vector<MadeReceiver> receivers;
};

// What a test changes before packing it.
struct MadeBake {
    uint32_t bands = 3;
    LinkForm linkForm = LinkForm::coefficients;
    uint32_t terms = 2; // of a node
    glm::vec3 origin{0.0f};
    float spacing = 1.0f;
    glm::uvec3 bricks{1};
    std::vector<MadeSurfel> surfels{MadeSurfel{}};
    std::vector<MadeCache> caches;
    std::vector<MadeCell> cells;
    std::vector<uint32_t> brickOf;     // by brick: the filled one in effect
    std::vector<uint32_t> cellOfBrick; // by filled brick, 64 each
    uint32_t surfaceCaches = 0;        // the last ones
    glm::uvec2 mapSize{0};
    std::vector<uint32_t> mapTexels;

    uint32_t cellAt(glm::uvec3 place) const {
        const glm::uvec3 brick = place / 4u, within = place % 4u;
        const uint32_t filled = brickOf[(brick.z * bricks.y + brick.y) * bricks.x + brick.x];
        return cellOfBrick[64 * filled + (within.z * 4 + within.y) * 4 + within.x];
    }
    Bake pack() const;
};

inline void fillBricks(MadeBake& made) {
    const glm::uvec3 cells = 4u * made.bricks, corners = cells + 1u;
    for (uint32_t z = 0; z < corners.z; ++z)
        for (uint32_t y = 0; y < corners.y; ++y)
            for (uint32_t x = 0; x < corners.x; ++x)
                made.caches.push_back({made.origin + made.spacing * glm::vec3(x, y, z), {}});
    for (uint32_t b = 0; b < made.bricks.x * made.bricks.y * made.bricks.z; ++b) {
        made.brickOf.push_back(b);
        const glm::uvec3 first = 4u * glm::uvec3(b % made.bricks.x, b / made.bricks.x % made.bricks.y,
                                                 b / (made.bricks.x * made.bricks.y));
        for (uint32_t i = 0; i < 64; ++i) {
            MadeCell cell;
            cell.place = first + glm::uvec3(i % 4, i / 4 % 4, i / 16);
            for (uint32_t k = 0; k < 8; ++k) {
                const glm::uvec3 at = cell.place + glm::uvec3(k & 1, k >> 1 & 1, k >> 2);
                cell.caches[k] = (at.z * corners.y + at.y) * corners.x + at.x;
            }
            made.cellOfBrick.push_back(uint32_t(made.cells.size()));
            made.cells.push_back(cell);
        }
    }
}

// Every cache stands where the grid has it, every cell has its eight, and no cache has a link.
inline MadeBake wholeGrid(glm::uvec3 bricks, glm::vec3 origin = glm::vec3(0.0f), float spacing = 1.0f) {
    MadeBake made;
    made.bricks = bricks;
    made.origin = origin;
    made.spacing = spacing;
    fillBricks(made);
    return made;
}

// The factor of a sender of area 1 that fills all directions: a cache linked to it receives its radiance from everywhere.
inline float factorOfSphere() { return std::sqrt(4.0f * 3.14159265f); }

namespace made {

// Level by level; a node that is left over waits for the next one.
inline void packTree(const MadeBake& made, BakeLayout& layout, std::vector<uint32_t>& terms) {
    std::vector<uint32_t> level(layout.surfels);
    for (uint32_t i = 0; i < layout.surfels; ++i) level[i] = i;
    layout.nodes = layout.surfels;
    constexpr uint32_t none = 0xffffffffu;
    while (level.size() > 1) {
        const uint32_t count = uint32_t(level.size()), rest = count % made.terms == 1 ? 1 : 0;
        BakeStage& stage = layout.stage[layout.stages++];
        stage = {layout.nodes, (count - rest + made.terms - 1) / made.terms, made.terms,
                 uint32_t(terms.size())};
        layout.nodes += stage.nodes;
        std::vector<uint32_t> next;
        for (uint32_t i = 0; i < stage.nodes; ++i) next.push_back(stage.firstNode + i);
        if (rest == 1) next.push_back(level.back());
        for (uint32_t t = 0; t < made.terms; ++t)
            for (uint32_t i = 0; i < BakeLayout::stride(stage.nodes); ++i) {
                const uint32_t term = i * made.terms + t;
                terms.push_back(i < stage.nodes && term < count - rest ? level[term] : none);
            }
        level = std::move(next);
    }
    for (uint32_t& term : terms)
        if (term == none) term = layout.nodes;
}

inline uint32_t packPlace(glm::vec3 within) {
    uint32_t packed = 0;
    for (int axis = 0; axis < 3; ++axis)
        packed |= uint32_t(std::lround((within[axis] + 1.0f) * 341.0f)) << (10 * axis);
    return packed;
}

inline uint32_t packShape(const BakeLayout& layout, const MadeLink& link, uint32_t word) {
    if (layout.linkForm == LinkForm::direction) return packOctahedral(link.direction);
    const uint32_t bits = layout.bands == 2 ? 10 : 8, inWord = layout.bands == 2 ? 3 : 4;
    uint32_t packed = 0;
    for (uint32_t i = 0; i < inWord; ++i)
        if (const uint32_t coefficient = 1 + word * inWord + i; coefficient < layout.coefficients())
            packed |= (uint32_t(link.shape[coefficient]) & ((1u << bits) - 1)) << (i * bits);
    return packed;
}

} // namespace made

inline Bake MadeBake::pack() const {
    auto storage = std::make_shared<std::array<std::vector<uint32_t>, bakeSectionCount>>();
    const auto section = [&](BakeSection s) -> std::vector<uint32_t>& { return (*storage)[size_t(s)]; };
    Bake bake;
    BakeLayout& l = bake.layout;
    l.bands = bands;
    l.linkForm = linkForm;
    l.origin = origin;
    l.spacing = spacing;
    l.bricks = bricks;
    l.surfels = uint32_t(surfels.size());
    l.caches = uint32_t(caches.size());
    l.cells = uint32_t(cells.size());
    l.surfaceCaches = surfaceCaches;
    l.mapSize = mapSize;
    l.mapTriangles = surfaceCaches > 0 ? 1 : 0;
    l.mapTexel = surfaceCaches > 0 ? 1.0f : 0.0f;
    l.filledBricks = uint32_t(cellOfBrick.size() / 64);
    for (const MadeCache& c : caches) l.links = std::max(l.links, std::max(1u, uint32_t(c.links.size())));
    for (const MadeCell& c : cells) l.receivers += uint32_t(c.receivers.size());
    made::packTree(*this, l, section(BakeSection::terms));

    for (int i = 0; i < bakeSectionCount; ++i) (*storage)[size_t(i)].resize(sizeOf(l, BakeSection{i}));
    const uint32_t surfelStride = BakeLayout::stride(l.surfels);
    for (uint32_t i = 0; i < l.surfels; ++i) {
        const MadeSurfel& s = surfels[i];
        const uint32_t numbers[7] = {bitsOf(s.position.x),     bitsOf(s.position.y), bitsOf(s.position.z),
                                     packOctahedral(s.normal), bitsOf(s.area),       packAlbedo(s.albedo),
                                     packEmission(s.emission)};
        for (uint32_t k = 0; k < 7; ++k) section(BakeSection::surfels)[k * surfelStride + i] = numbers[k];
    }
    std::fill(section(BakeSection::linkNodes).begin(), section(BakeSection::linkNodes).end(), l.nodes);
    for (uint32_t c = 0; c < l.caches; ++c) {
        for (int axis = 0; axis < 3; ++axis)
            section(BakeSection::places)[4 * c + uint32_t(axis)] = bitsOf(caches[c].place[axis]);
        for (uint32_t j = 0; j < caches[c].links.size(); ++j) {
            const MadeLink& link = caches[c].links[j];
            section(BakeSection::linkNodes)[BakeLayout::ofCache(c, j, l.links)] = link.node;
            section(BakeSection::linkFactors)[BakeLayout::ofCache(c, j, l.links)] = bitsOf(link.factor);
            for (uint32_t w = 0; w < l.shapeWords(); ++w)
                section(BakeSection::linkShapes)[BakeLayout::ofCache(
                    c, j * l.shapeWords() + w, l.links * l.shapeWords())] = made::packShape(l, link, w);
        }
    }
    section(BakeSection::bricks) = brickOf;
    section(BakeSection::mapTexels) = mapTexels;
    section(BakeSection::brickCells) = cellOfBrick;
    uint32_t receiver = 0;
    for (uint32_t c = 0; c < l.cells; ++c) {
        const MadeCell& cell = cells[c];
        uint32_t* record = &section(BakeSection::cells)[12 * c];
        std::copy(cell.caches.begin(), cell.caches.end(), record);
        record[8] = cell.place.x | cell.place.y << 10 | cell.place.z << 20;
        record[9] = receiver;
        record[10] = uint32_t(cell.receivers.size());
        for (const MadeReceiver& r : cell.receivers) {
            uint32_t* words = &section(BakeSection::receivers)[4 * receiver++];
            words[0] = made::packPlace(r.within);
            words[1] = packOctahedral(r.normal);
            for (uint32_t k = 0; k < 8; ++k) words[2 + k / 4] |= uint32_t(r.shares[k]) << (8 * (k % 4));
        }
    }
    for (int i = 0; i < bakeSectionCount; ++i) bake.sections[size_t(i)] = (*storage)[size_t(i)];
    bake.storage = storage;
    return bake;
}

} // namespace rebound::test
