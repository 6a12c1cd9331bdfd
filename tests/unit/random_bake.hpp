// SPDX-License-Identifier: MIT
// Bakes without a pattern that obey every rule, in the view of CompositionFrames.
#pragma once

#include "made_bake.hpp"

#include <cstdint>

namespace rebound::test {

// The same numbers everywhere.
class Numbers32 {
public:
    explicit Numbers32(uint32_t seed) : state(seed * 2u + 1u) {}
    uint32_t next() {
        state = state * 1664525u + 1013904223u;
        return (state >> 16) ^ (state << 7);
    }
    uint32_t below(uint32_t end) { return next() % end; }
    float unit() { return float(next() & 0xffffffu) / 16777216.0f; }
    float within(float low, float high) { return low + (high - low) * unit(); }
    glm::vec3 vector(float low, float high) {
        const float x = within(low, high), y = within(low, high), z = within(low, high);
        return {x, y, z};
    }
    glm::vec3 direction() {
        for (;;)
            if (const glm::vec3 v = vector(-1.0f, 1.0f); glm::dot(v, v) > 0.01f && glm::dot(v, v) <= 1.0f)
                return glm::normalize(v);
    }

private:
    uint32_t state;
};

inline void scatterGrid(MadeBake& made, Numbers32& random) {
    for (MadeCache& c : made.caches)
        if (random.below(3) == 0) c.place += 0.4f * made.spacing * random.vector(-1.0f, 1.0f);
    // One brick has no cells of its own, another one shares some.
    made.brickOf[1] = 0;
    for (uint32_t i = 0; i < 20; ++i)
        made.cellOfBrick[random.below(128)] = random.below(uint32_t(made.cells.size()));
    for (MadeCell& cell : made.cells) {
        for (uint32_t k = 0; k < 8; ++k)
            if (random.below(6) == 0) cell.caches[k] = 0xffffffffu;
        if (random.below(40) == 0) cell.caches.fill(0xffffffffu);
        for (uint32_t r = random.below(5); r > 0; --r) {
            MadeReceiver receiver{random.vector(-0.9f, 1.9f), random.direction(), {}};
            for (int& share : receiver.shares) share = random.below(2) == 0 ? 255 : int(random.below(256));
            cell.receivers.push_back(receiver);
        }
    }
}

// Before links are made.
inline void addMap(MadeBake& made, Numbers32& random, uint32_t caches) {
    const uint32_t first = uint32_t(made.caches.size());
    made.caches.resize(first + caches);
    made.surfaceCaches = caches;
    made.mapSize = {7, 5};
    for (uint32_t i = 0; i < 35; ++i)
        made.mapTexels.push_back(random.below(7) == 0
                                     ? BakeLayout::noMapCache | random.below(5) << 24
                                     : (first + random.below(caches)) | random.below(4) << 24);
}

// caches of its map: 0: it has none.
inline MadeBake randomBake(uint32_t seed, uint32_t bands, LinkForm form, uint32_t surfels, uint32_t terms,
                           uint32_t caches = 0) {
    Numbers32 random(seed);
    MadeBake made = wholeGrid(glm::uvec3(2, 1, 2), {0.0f, 2.0f, -8.0f});
    made.bands = bands;
    made.linkForm = form;
    made.terms = terms;
    made.surfels.clear();
    for (uint32_t i = 0; i < surfels; ++i)
        made.surfels.push_back({random.vector(-1.0f, 9.0f) - glm::vec3(0, 0, 9), random.direction(),
                                random.within(0.5f, 2.0f) / float(surfels), random.vector(0.0f, 0.9f),
                                random.vector(0.0f, 2.0f)});
    scatterGrid(made, random);
    if (caches > 0) addMap(made, random, caches);
    const uint32_t nodes = made.pack().layout.nodes;
    for (MadeCache& cache : made.caches)
        for (uint32_t j = random.below(9); j > 0; --j) {
            MadeLink link{random.below(nodes + 1), random.within(0.0f, 0.8f), {}, random.direction()};
            for (int& s : link.shape) s = int(random.below(255)) - 127;
            cache.links.push_back(link);
        }
    return made;
}

} // namespace rebound::test
