// SPDX-License-Identifier: MIT
// Sample patterns of a level: which few texels stand for all texels of a disc or a ring.
#pragma once

#include "rebound/extent.hpp"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace rebound {

// What lies at the offset from the receiver stands for weight texels, itself included.
struct RingTexel {
    glm::ivec2 offset{0};
    float weight = 0;
};

// The part of a level around the receiver that it gathers. Level 0 gathers the disc of the radius. Every other level
// gathers what the disc of the same radius in the next finer level, which is half as wide, leaves out: a ring
// [radius / 2, radius]. Thus all levels together tile a disc with neither gap nor overlap.          [RR-7162, fig. 2]
struct Ring {
    float radius = 40.0f; // outer radius [texels of the level]
    bool isDisc = false;  // level 0
    bool isOpen = false;  // no outer end but the screen's: for the coarsest level
};

// An open ring's outer radius is the level's diagonal, but no more than this or its radius [texels]: with few levels at
// high resolutions a ring would otherwise hold a thousand million texels.
inline constexpr double openRingReach = 1024.0;

// Every texel of a ring, apart from the receiver itself. On the inner edge a texel weighs the share of it that the finer
// level leaves out, averaged over the four places in a texel where a finer receiver may lie. Texels that lie outside the
// level for every receiver are left out.
std::vector<RingTexel> ringTexels(const Ring&, Extent2D level);

// Patterns of as many texels each, one behind the other.
struct RingPatterns {
    std::vector<RingTexel> texels;
    int count = 0;        // of one pattern
    bool isShared = true; // there is one pattern, for all receivers
};

// Few texels that stand for all of a ring's. The ring is cut into cells of nearly equal importance, annuli cut into
// sectors, and each pattern takes a texel from every cell, which weighs the cell. Cells are smaller near the receiver,
// where light changes fastest, and where more receivers have them on the screen. With four patterns, for the receivers
// of a 2x2 block, each takes its texel from another quarter of the cell, so that all together are a pattern of four
// times as many samples, and their mean weighs every texel once. With as many samples as texels each texel stands for
// itself: the brute-force sum of the ring.
//   samples    at most that many a pattern
//   patterns   1 or 4; pattern column + 2 row is that of a receiver in an even or odd column and row
RingPatterns ringPatterns(const Ring&, int samples, int patterns, Extent2D level);

} // namespace rebound

#include "rebound/detail/rings.inl"
