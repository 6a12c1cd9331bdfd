// SPDX-License-Identifier: MIT
#include "rebound/bake/hierarchy.hpp"

#include "rebound/bake/packing.hpp"

#include "joins.hpp"
#include "tree_stages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <string>

namespace rebound {

namespace {

using detail::Cluster;
using detail::Joins;
using detail::NodeSum;

bool isFinite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Result<> check(std::span<const Surfel> surfels) {
    constexpr size_t most = 1 << 24;
    if (surfels.empty() || surfels.size() > most)
        return invalidArgument("surfels are " + std::to_string(surfels.size()) + "; 1 to " +
                               std::to_string(most) + " were expected");
    for (size_t i = 0; i < surfels.size(); ++i) {
        const Surfel& surfel = surfels[i];
        const std::string name = "surfels[" + std::to_string(i) + "]";
        if (!isFinite(surfel.position) || !isFinite(surfel.normal) || !isFinite(surfel.open) ||
            !isFinite(surfel.prospect))
            return invalidArgument(
                name + " has a position or direction that is not finite; finite numbers were expected");
        if (!(surfel.area > 0.0f) || !std::isfinite(surfel.area))
            return invalidArgument(name + ".area is " + std::to_string(surfel.area) +
                                   "; a finite one of more than 0 was expected");
    }
    return {};
}

std::vector<Cluster> clustersOf(std::span<const Surfel> surfels) {
    std::vector<Cluster> clusters;
    clusters.reserve(surfels.size());
    for (const Surfel& surfel : surfels) {
        Cluster cluster;
        cluster.position = glm::dvec3(surfel.position);
        cluster.normal = glm::dvec3(surfel.normal);
        cluster.open = glm::dvec3(surfel.open);
        cluster.prospect = glm::dvec3(surfel.prospect);
        cluster.area = double(surfel.area);
        clusters.push_back(cluster);
    }
    return clusters;
}

// Numbers of the tree's nodes for clusters, and the other way round.
struct Numbering {
    std::vector<uint32_t> nodeOf;    // by cluster
    std::vector<uint32_t> clusterOf; // by node
};

// Leaves depth first; then inner nodes by stage, and depth first within one, children before parents.
Numbering number(size_t surfels, const Joins& joins, const std::vector<NodeSum>& sums, uint32_t stages) {
    Numbering numbering;
    numbering.nodeOf.resize(sums.size());
    std::vector<std::vector<uint32_t>> byStage(stages + 1);
    std::vector<uint32_t> pending{uint32_t(sums.size() - 1)};
    // Parents before children, later ones first: reversed, children before parents.
    while (!pending.empty()) {
        const uint32_t cluster = pending.back();
        pending.pop_back();
        byStage[sums[cluster].stage].push_back(cluster);
        if (cluster >= surfels)
            for (const uint32_t child : joins[cluster - surfels]) pending.push_back(child);
    }
    for (std::vector<uint32_t>& clusters : byStage)
        for (auto i = clusters.rbegin(); i != clusters.rend(); ++i) {
            numbering.nodeOf[*i] = uint32_t(numbering.clusterOf.size());
            numbering.clusterOf.push_back(*i);
        }
    return numbering;
}

void fillNodes(std::span<const Surfel> surfels, const Joins& joins, const Numbering& numbering,
               SurfelTree& tree) {
    std::vector<Cluster> clusters = clustersOf(surfels);
    clusters.reserve(surfels.size() + joins.size());
    for (const auto& [a, b] : joins) clusters.push_back(joined(clusters[a], clusters[b]));
    tree.nodes.resize(clusters.size());
    for (uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const uint32_t cluster = numbering.clusterOf[i];
        SurfelNode& node = tree.nodes[i];
        node.position = glm::vec3(clusters[cluster].position);
        node.normal = glm::vec3(clusters[cluster].normal);
        node.area = float(clusters[cluster].area);
        node.leaves = clusters[cluster].surfels;
        if (cluster < surfels.size()) {
            node.firstLeaf = i;
            node.lower = node.upper = surfels[cluster].position;
            node.emission = glm::dot(surfels[cluster].emission, glm::vec3(1.0f / 3.0f));
            continue;
        }
        const auto& join = joins[cluster - surfels.size()];
        node.children = {numbering.nodeOf[join[0]], numbering.nodeOf[join[1]]};
        const SurfelNode& a = tree.nodes[node.children[0]];
        const SurfelNode& b = tree.nodes[node.children[1]];
        node.firstLeaf = std::min(a.firstLeaf, b.firstLeaf);
        node.lower = glm::min(a.lower, b.lower);
        node.upper = glm::max(a.upper, b.upper);
        node.emission = glm::mix(a.emission, b.emission, b.area / (a.area + b.area));
    }
    tree.order.assign(numbering.clusterOf.begin(),
                      numbering.clusterOf.begin() + std::ptrdiff_t(surfels.size()));
}

void fillStages(size_t surfels, const std::vector<NodeSum>& sums, const Numbering& numbering,
                SurfelTree& tree) {
    for (auto first = uint32_t(surfels); first < sums.size();) {
        BakeStage stage;
        stage.firstNode = first;
        stage.firstTerm = uint32_t(tree.terms.size());
        const uint32_t number = sums[numbering.clusterOf[first]].stage;
        for (uint32_t i = first; i < sums.size() && sums[numbering.clusterOf[i]].stage == number; ++i) {
            ++stage.nodes;
            stage.terms = std::max(stage.terms, sums[numbering.clusterOf[i]].terms);
        }
        const uint32_t stride = BakeLayout::stride(stage.nodes);
        tree.terms.resize(tree.terms.size() + size_t(stage.terms) * stride, tree.emptyNode());
        for (uint32_t i = 0; i < stage.nodes; ++i) {
            const NodeSum& sum = sums[numbering.clusterOf[first + i]];
            for (uint32_t k = 0; k < sum.terms; ++k)
                tree.terms[stage.firstTerm + size_t(k) * stride + i] = numbering.nodeOf[sum.term[k]];
        }
        tree.stages.push_back(stage);
        first += stage.nodes;
    }
}

uint32_t stagesOf(const std::vector<NodeSum>& sums) {
    uint32_t most = 0;
    for (const NodeSum& sum : sums) most = std::max(most, sum.stage);
    return most;
}

// Ours were chosen by the error of light from 128 links, to that of all surfels one by one, in nine scenes.
detail::ClusterWeights weightsOf(BakeHierarchy hierarchy) {
    if (hierarchy == BakeHierarchy::paper) return {};
    return {.normal = 0.1, .balance = 0.0, .open = 0.3, .prospect = 1.0};
}

// Of at least one cluster, in fewer stages than a bake may have: one is left for a root above.
Joins shallowJoins(std::span<const Cluster> clusters, BakeHierarchy hierarchy, int threads) {
    const detail::ClusterWeights weights = weightsOf(hierarchy);
    Joins joins = hierarchy == BakeHierarchy::kdTree ? detail::joinHalves(clusters, weights)
                                                     : detail::joinNearest(clusters, weights, threads);
    if (stagesOf(detail::sumsOf(clusters.size(), joins)) >= uint32_t(maximumBakeStages))
        joins = detail::rebalanced(clusters, joins, weights);
    return joins;
}

// Lamps join lamps alone, up to the root. A node of lamps and of what they light would send the mean of both, and lamps
// have by far the most of it.
Joins joinsOf(std::span<const Surfel> surfels, BakeHierarchy hierarchy, int threads) {
    const std::vector<Cluster> clusters = clustersOf(surfels);
    std::array<std::vector<uint32_t>, 2> kinds;
    for (uint32_t i = 0; i < surfels.size(); ++i) {
        const bool emits = glm::any(glm::greaterThan(surfels[i].emission, glm::vec3(0.0f)));
        kinds[emits && hierarchy != BakeHierarchy::paper ? 1 : 0].push_back(i);
    }
    Joins joins;
    std::vector<uint32_t> roots;
    for (const std::vector<uint32_t>& kind : kinds) {
        if (kind.empty()) continue;
        std::vector<Cluster> members;
        for (const uint32_t i : kind) members.push_back(clusters[i]);
        const auto first = uint32_t(clusters.size() + joins.size()), count = uint32_t(kind.size());
        const auto number = [&](uint32_t member) {
            return member < count ? kind[member] : first + member - count;
        };
        for (const auto& [a, b] : shallowJoins(members, hierarchy, threads))
            joins.push_back({number(a), number(b)});
        roots.push_back(number(2 * count - 2));
    }
    if (roots.size() == 2) joins.push_back({roots[0], roots[1]});
    return joins;
}

SurfelTree build(std::span<const Surfel> surfels, BakeHierarchy hierarchy, int threads) {
    const Joins joins = joinsOf(surfels, hierarchy, threads);
    const std::vector<NodeSum> sums = detail::sumsOf(surfels.size(), joins);
    SurfelTree tree;
    const Numbering numbering = number(surfels.size(), joins, sums, stagesOf(sums));
    fillNodes(surfels, joins, numbering, tree);
    fillStages(surfels.size(), sums, numbering, tree);
    return tree;
}

} // namespace

Result<SurfelTree> buildSurfelTree(std::span<const Surfel> surfels, BakeHierarchy hierarchy, int threads) {
    if (auto valid = check(surfels); !valid) return valid.error();
    try {
        return build(surfels, hierarchy, threads);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory,
                     "out of memory while building a tree of " + std::to_string(surfels.size()) + " surfels"};
    }
}

void setTree(BakeLayout& layout, const SurfelTree& tree) {
    layout.surfels = uint32_t(tree.order.size());
    layout.nodes = uint32_t(tree.nodes.size());
    layout.stages = uint32_t(tree.stages.size());
    layout.stage = {};
    std::copy(tree.stages.begin(), tree.stages.end(), layout.stage.begin());
}

std::vector<uint32_t> packSurfels(const SurfelTree& tree, std::span<const Surfel> surfels) {
    const size_t stride = BakeLayout::stride(uint32_t(surfels.size()));
    std::vector<uint32_t> section(7 * stride);
    for (size_t i = 0; i < tree.order.size(); ++i) {
        const Surfel& surfel = surfels[tree.order[i]];
        const std::array<uint32_t, 7> numbers{
            std::bit_cast<uint32_t>(surfel.position.x),
            std::bit_cast<uint32_t>(surfel.position.y),
            std::bit_cast<uint32_t>(surfel.position.z),
            packOctahedral(surfel.normal),
            std::bit_cast<uint32_t>(surfel.area),
            packAlbedo(surfel.albedo),
            packEmission(surfel.emission),
        };
        for (size_t k = 0; k < numbers.size(); ++k) section[k * stride + i] = numbers[k];
    }
    return section;
}

} // namespace rebound
