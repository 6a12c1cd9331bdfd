// SPDX-License-Identifier: MIT
// Links from caches to the senders that they see: a cut through the tree for each.   [PIC, sec. 4.5]
#pragma once

#include "facing.hpp"

#include "rebound/bake/bake_scene.hpp"
#include "rebound/bake/hierarchy.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rebound::detail {

// Sections linkNodes, linkFactors and linkShapes of a bake.
struct LinkSections {
    std::vector<uint32_t> nodes, factors, shapes;
};

// normals: of the last caches, which lie on surfaces, as many as there are. emitters: leaves of the tree that emit,
// ascending. progress: share of caches that have theirs.
LinkSections linkCaches(const Surroundings&, std::span<const glm::vec3> caches,
                        std::span<const glm::vec3> normals, const SurfelTree&,
                        std::span<const uint32_t> emitters, const BakeSettings&,
                        const std::function<void(double)>& progress);

} // namespace rebound::detail
