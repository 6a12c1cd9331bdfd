// SPDX-License-Identifier: MIT
// Sample patterns of a level: which few texels stand for all texels of a disc or a ring.
#pragma once

#include "rebound/extent.hpp"

#include <glm/glm.hpp>

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

// At most that many texels that stand for all of the ring's: every texel belongs to the sample nearest to it, and a
// sample weighs its texels. Samples are denser near the receiver, where light changes fastest, and where more receivers
// have them on the screen; otherwise they are spread as evenly as Lloyd's relaxation makes them, which leaves fewer
// blotches than spirals do. With as many samples as texels each stands for itself: the brute-force sum of the ring.
std::vector<RingTexel> ringPattern(const Ring&, int samples, Extent2D level);

} // namespace rebound

#include "rebound/detail/rings.inl"
