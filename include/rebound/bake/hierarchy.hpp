// SPDX-License-Identifier: MIT
// A binary tree over surfels: the senders that caches are linked with.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/bake_scene.hpp"
#include "rebound/bake/surfels.hpp"
#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rebound {

// A surfel, or two nodes that send light together.
struct SurfelNode {
    glm::vec3 position{0.0f}; // mean by area [m]
    float area = 0.0f;        // of its surfels together [m^2]
    glm::vec3 normal{0.0f};   // mean by area: the shorter, the more its surfels face different ways
    uint32_t firstLeaf = 0;   // its surfels are leaves firstLeaf to firstLeaf + leaves - 1
    glm::vec3 lower{0.0f};    // of the box around its surfels' positions [m]
    uint32_t leaves = 1;
    glm::vec3 upper{0.0f};
    std::array<uint32_t, 2> children{}; // numbers of nodes, lower than its own; of inner nodes only
    float emission = 0.0f;              // mean by area and of the three channels [W m^-2 sr^-1]

    bool isLeaf() const { return leaves == 1; }
};

// Nodes are numbered as in a bake: leaves in depth-first order, then inner nodes by stage; the last is the root.
struct SurfelTree {
    std::vector<uint32_t> order;   // leaf i is surfel order[i]
    std::vector<SurfelNode> nodes; // 2 * surfels - 1
    std::vector<BakeStage> stages; // at most maximumBakeStages
    std::vector<uint32_t> terms;   // section terms of a bake

    uint32_t root() const { return uint32_t(nodes.size()) - 1; }
    uint32_t emptyNode() const { return uint32_t(nodes.size()); }
};

// The same for any number of threads; 0: one a core. Fails where there are no surfels or more than 2^24 of them, one is
// not finite or has no area, or memory is short.
Result<SurfelTree> buildSurfelTree(std::span<const Surfel>, BakeHierarchy, int threads = 0);

// Sets the numbers of surfels, nodes and stages.
void setTree(BakeLayout&, const SurfelTree&);

// Section surfels of a bake: in the order of the tree's leaves.
std::vector<uint32_t> packSurfels(const SurfelTree&, std::span<const Surfel>);

} // namespace rebound
