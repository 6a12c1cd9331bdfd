// SPDX-License-Identifier: MIT
#include "surfel_lookup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace rebound::detail {

namespace {

constexpr int rings = 3; // of cells around a place that are searched
constexpr float planeWeight =
    4.0f; // of the squared distance from the surfel's plane, beside that of the distance
constexpr float normalWeight = 1.0f; // of 1 - cosine, in squared sides of cells

} // namespace

SurfelLookup::SurfelLookup(std::span<const SurfelNode> nodes) : leaves(nodes) {
    double area = 0.0;
    for (const SurfelNode& leaf : leaves) area += leaf.area;
    side = float(1.5 * std::sqrt(area / double(leaves.size())));
    mask = std::bit_ceil(uint32_t(2 * leaves.size())) - 1;
    std::vector<uint32_t> bucket(leaves.size());
    firstOf.assign(size_t(mask) + 2, 0);
    for (size_t i = 0; i < leaves.size(); ++i) {
        bucket[i] = bucketOf(glm::ivec3(glm::floor(leaves[i].position / side)));
        ++firstOf[bucket[i] + 1];
    }
    for (size_t b = 1; b < firstOf.size(); ++b) firstOf[b] += firstOf[b - 1];
    members.resize(leaves.size());
    std::vector<uint32_t> next(firstOf.begin(), firstOf.end() - 1);
    for (uint32_t i = 0; i < leaves.size(); ++i) members[next[bucket[i]]++] = i;
}

// Teschner et al.: Optimized Spatial Hashing for Collision Detection of Deformable Objects, 2003.
uint32_t SurfelLookup::bucketOf(glm::ivec3 cell) const {
    const glm::uvec3 c(cell);
    return (c.x * 73856093u ^ c.y * 19349663u ^ c.z * 83492791u) & mask;
}

uint32_t SurfelLookup::nearest(glm::vec3 position, glm::vec3 normal) const {
    const glm::ivec3 centre(glm::floor(position / side));
    uint32_t best = noLeaf;
    float least = float(rings * rings) * side * side;
    for (int ring = 0; ring <= rings; ++ring) {
        for (int z = -ring; z <= ring; ++z)
            for (int y = -ring; y <= ring; ++y) {
                const bool inner = std::abs(z) < ring && std::abs(y) < ring;
                for (int x = -ring; x <= ring; x += inner ? std::max(2 * ring, 1) : 1) {
                    const uint32_t bucket = bucketOf(centre + glm::ivec3(x, y, z));
                    for (uint32_t m = firstOf[bucket]; m < firstOf[bucket + 1]; ++m) {
                        const SurfelNode& leaf = leaves[members[m]];
                        const float cosine = glm::dot(leaf.normal, normal);
                        if (cosine <= 0.0f) continue;
                        const glm::vec3 offset = position - leaf.position;
                        const float height = glm::dot(offset, leaf.normal);
                        const float score = glm::dot(offset, offset) + planeWeight * height * height +
                                            normalWeight * (1.0f - cosine) * side * side;
                        if (score < least || (score == least && members[m] < best)) {
                            least = score;
                            best = members[m];
                        }
                    }
                }
            }
        // Whatever lies further out is further away than this.
        if (best != noLeaf && least <= float(ring * ring) * side * side) break;
    }
    return best;
}

} // namespace rebound::detail
