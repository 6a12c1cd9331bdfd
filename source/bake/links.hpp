// SPDX-License-Identifier: MIT
// Links from caches to the senders that they see: a cut through the tree for each.   [PIC, sec. 4.5]
#pragma once

#include "facing.hpp"
#include "surfel_lookup.hpp"

#include "rebound/bake/bake_scene.hpp"
#include "rebound/bake/hierarchy.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rebound::detail {

// Sections linkNodes, linkFactors and linkShapes of a bake.
struct LinkSections {
    std::vector<uint32_t> nodes, factors, shapes;
};

// Of caches first to last - 1 alone: their stretches of these sections. first: a multiple of 64; last: too, or the number
// of caches. normals: of the last of all caches, which lie on surfaces, as many as there are. lookup: of the tree's
// leaves.
LinkSections linkCaches(const Surroundings&, std::span<const glm::vec3> caches,
                        std::span<const glm::vec3> normals, uint32_t first, uint32_t last, const SurfelTree&,
                        const SurfelLookup&, const BakeSettings&);

} // namespace rebound::detail
