// SPDX-License-Identifier: MIT
// Which surfel stands for a place on a surface.
#pragma once

#include "rebound/bake/hierarchy.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rebound::detail {

inline constexpr uint32_t noLeaf = 0xffffffffu;

class SurfelLookup {
public:
    // Keeps a reference to the leaves.
    explicit SurfelLookup(std::span<const SurfelNode> leaves);

    // Number of the nearest leaf on that side of a surface; noLeaf: none is near, as on sides that light cannot reach.
    uint32_t nearest(glm::vec3 position, glm::vec3 normal) const;

private:
    uint32_t bucketOf(glm::ivec3 cell) const;

    std::span<const SurfelNode> leaves;
    float side = 1.0f;             // of cells [m]
    uint32_t mask = 0;             // of bucket numbers
    std::vector<uint32_t> firstOf; // in `members`, of each bucket, and one past the last
    std::vector<uint32_t> members; // leaves by bucket
};

} // namespace rebound::detail
