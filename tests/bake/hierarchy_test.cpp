// SPDX-License-Identifier: MIT
#include "rebound/bake/hierarchy.hpp"
#include "rebound/bake/packing.hpp"

#include "cluster_tree.hpp"
#include "joins.hpp"
#include "tree_stages.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace rebound;

namespace {

// Of the six inner sides of a box and of both sides of a wall across it, of 1 cm.
std::vector<Surfel> roomWithWall(uint32_t count) {
    std::mt19937 random(3);
    const auto uniform = [&] { return float(random()) / 4294967296.0f; };
    std::vector<Surfel> surfels;
    for (uint32_t i = 0; i < count; ++i) {
        Surfel surfel;
        surfel.area = 0.5f + uniform();
        surfel.albedo = glm::vec3(uniform());
        const glm::vec3 place = 8.0f * glm::vec3(uniform(), uniform(), uniform());
        const int side = int(i % 8);
        surfel.position = place;
        if (side < 6) {
            surfel.position[side / 2] = side % 2 ? 8.0f : 0.0f;
            surfel.normal[side / 2] = side % 2 ? -1.0f : 1.0f;
        } else {
            surfel.position.x = side == 6 ? 3.995f : 4.005f;
            surfel.normal.x = side == 6 ? -1.0f : 1.0f;
        }
        surfels.push_back(surfel);
    }
    return surfels;
}

// In a row, each gap 1.02 times as long as the one before: none but the first two are nearest to each other.
std::vector<Surfel> growingRow(uint32_t count) {
    std::vector<Surfel> surfels(count);
    double place = 0.0, gap = 1e-3;
    for (Surfel& surfel : surfels) {
        surfel.position.x = float(place);
        surfel.normal = {0, 1, 0};
        surfel.area = 1.0f;
        place += gap;
        gap *= 1.02;
    }
    return surfels;
}

SurfelTree treeOf(const std::vector<Surfel>& surfels, BakeHierarchy hierarchy, int threads = 0) {
    auto tree = buildSurfelTree(surfels, hierarchy, threads);
    REQUIRE_MESSAGE(tree, tree.error().message);
    return *tree;
}

constexpr std::array hierarchies{BakeHierarchy::cluster, BakeHierarchy::kdTree, BakeHierarchy::paper};

void checkTree(const SurfelTree& tree, const std::vector<Surfel>& surfels) {
    const auto count = uint32_t(surfels.size());
    std::vector<uint32_t> sorted = tree.order;
    std::sort(sorted.begin(), sorted.end());
    REQUIRE(sorted.size() == count);
    for (uint32_t i = 0; i < count; ++i) REQUIRE(sorted[i] == i);
    REQUIRE(tree.nodes.size() == 2 * count - 1);
    std::vector<int> parents(tree.nodes.size());
    for (uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const SurfelNode& node = tree.nodes[i];
        REQUIRE(node.isLeaf() == (i < count));
        // Means and sums, by a plain loop over the node's surfels.
        double area = 0.0;
        glm::dvec3 position(0.0), normal(0.0);
        glm::vec3 lower(std::numeric_limits<float>::infinity()), upper = -lower;
        for (uint32_t leaf = node.firstLeaf; leaf < node.firstLeaf + node.leaves; ++leaf) {
            const Surfel& surfel = surfels[tree.order[leaf]];
            area += double(surfel.area);
            position += double(surfel.area) * glm::dvec3(surfel.position);
            normal += double(surfel.area) * glm::dvec3(surfel.normal);
            lower = glm::min(lower, surfel.position);
            upper = glm::max(upper, surfel.position);
        }
        // One rounding to single precision, of sums that differ in the last digits of double precision.
        constexpr double rounding = 1.2e-7;
        CHECK(std::abs(double(node.area) - area) <= rounding * area);
        CHECK(glm::length(glm::dvec3(node.position) - position / area) <= rounding * 16.0);
        CHECK(glm::length(glm::dvec3(node.normal) - normal / area) <= rounding * 2.0);
        CHECK(node.lower == lower);
        CHECK(node.upper == upper);
        if (node.isLeaf()) continue;
        const SurfelNode& a = tree.nodes[node.children[0]];
        const SurfelNode& b = tree.nodes[node.children[1]];
        REQUIRE(node.children[0] < i);
        REQUIRE(node.children[1] < i);
        CHECK(a.leaves + b.leaves == node.leaves);
        CHECK(std::min(a.firstLeaf, b.firstLeaf) == node.firstLeaf);
        CHECK(std::max(a.firstLeaf + a.leaves, b.firstLeaf + b.leaves) == node.firstLeaf + node.leaves);
        ++parents[node.children[0]];
        ++parents[node.children[1]];
    }
    CHECK(parents[tree.root()] == 0);
    CHECK(std::count(parents.begin(), parents.end(), 1) == std::ptrdiff_t(tree.nodes.size()) - 1);
}

// Sums whole numbers up as a run of the stages does, and compares them with sums over leaves.
void checkStages(const SurfelTree& tree) {
    const auto surfels = uint32_t(tree.order.size());
    BakeLayout layout;
    setTree(layout, tree);
    REQUIRE(layout.surfels == surfels);
    REQUIRE(layout.nodes == tree.nodes.size());
    REQUIRE(layout.stages <= uint32_t(maximumBakeStages));
    std::vector<uint64_t> sums(tree.nodes.size() + 1);
    for (uint32_t i = 0; i < surfels; ++i) sums[i] = 1 + uint64_t(i) * i;
    uint32_t next = surfels;
    size_t nextTerm = 0;
    for (uint32_t s = 0; s < layout.stages; ++s) {
        const BakeStage& stage = layout.stage[s];
        REQUIRE(stage.firstNode == next);
        REQUIRE(stage.firstTerm == nextTerm);
        REQUIRE(stage.terms >= 2);
        REQUIRE(stage.terms <= 8);
        const uint32_t stride = BakeLayout::stride(stage.nodes);
        nextTerm += size_t(stage.terms) * stride;
        REQUIRE(nextTerm <= tree.terms.size());
        for (uint32_t k = 0; k < stage.terms; ++k)
            for (uint32_t i = 0; i < stride; ++i) {
                const uint32_t term = tree.terms[stage.firstTerm + size_t(k) * stride + i];
                if (i >= stage.nodes) REQUIRE(term == tree.emptyNode());
                if (term == tree.emptyNode()) continue;
                REQUIRE(term < stage.firstNode);
                sums[stage.firstNode + i] += sums[term];
            }
        next += stage.nodes;
    }
    REQUIRE(next == tree.nodes.size());
    REQUIRE(nextTerm == tree.terms.size());
    std::vector<uint64_t> before{0};
    for (uint32_t i = 0; i < surfels; ++i) before.push_back(before.back() + sums[i]);
    for (uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const SurfelNode& node = tree.nodes[i];
        REQUIRE(sums[i] == before[node.firstLeaf + node.leaves] - before[node.firstLeaf]);
    }
}

} // namespace

TEST_CASE("Every surfel is under the root once, and nodes are means and sums of theirs") {
    for (const uint32_t count : {1u, 2u, 3u, 8u, 9u, 1000u})
        for (const BakeHierarchy hierarchy : hierarchies) {
            CAPTURE(count);
            const std::vector<Surfel> surfels = roomWithWall(count);
            const SurfelTree tree = treeOf(surfels, hierarchy);
            checkTree(tree, surfels);
            checkStages(tree);
        }
}

TEST_CASE("A tree of 20000 surfels takes few stages") {
    for (const BakeHierarchy hierarchy : hierarchies) {
        const SurfelTree tree = treeOf(roomWithWall(20000), hierarchy);
        checkStages(tree);
        CHECK(tree.stages.size() <= 8); // 8^5 = 32768: none could do with fewer than 5
    }
}

TEST_CASE("Surfels on two sides of a wall of 1 cm, nearer to each other than to those beside, join last") {
    const std::vector<Surfel> surfels = roomWithWall(4000);
    for (const BakeHierarchy hierarchy : hierarchies) {
        const SurfelTree tree = treeOf(surfels, hierarchy);
        uint32_t mixed = 0;
        for (const SurfelNode& node : tree.nodes) {
            bool left = false, right = false;
            for (uint32_t leaf = node.firstLeaf; leaf < node.firstLeaf + node.leaves; ++leaf) {
                const Surfel& surfel = surfels[tree.order[leaf]];
                if (surfel.position.x < 3.9f || surfel.position.x > 4.1f) continue;
                left = left || surfel.normal.x < 0.0f;
                right = right || surfel.normal.x > 0.0f;
            }
            mixed += left && right;
        }
        // Two clusters of opposite normals are 2 C_n = 0.2 apart, as places of half the diagonal are: hardly any is nearer, where a thousand leaves have their counterpart 1 cm away.
        CHECK(mixed >= 1);
        CHECK(mixed <= 16);
    }
}

TEST_CASE("Surfels that see the open, and those that emit, join their like before those in between") {
    // A floor in stripes of 1 m: under a roof and dark, under the sky, emitting.
    std::vector<Surfel> surfels;
    for (uint32_t i = 0; i < 2400; ++i) {
        Surfel surfel;
        surfel.position = {0.3f * float(i % 40), 0.0f, 0.3f * float(i / 40)};
        surfel.normal = {0, 1, 0};
        surfel.area = 0.09f;
        const int stripe = int(surfel.position.x) % 3;
        if (stripe == 1) surfel.open = {0, 0.6f, 0};
        if (stripe == 2) surfel.emission = glm::vec3(1.0f);
        surfels.push_back(surfel);
    }
    const auto mixedNodes = [&](BakeHierarchy hierarchy) {
        const SurfelTree tree = treeOf(surfels, hierarchy);
        int mixed = 0;
        for (const SurfelNode& node : tree.nodes) {
            std::array<bool, 3> kinds{};
            for (uint32_t leaf = node.firstLeaf; leaf < node.firstLeaf + node.leaves; ++leaf) {
                const Surfel& surfel = surfels[tree.order[leaf]];
                kinds[surfel.emission.x > 0.0f ? 2 : surfel.open.y > 0.0f] = true;
            }
            mixed += kinds[0] + kinds[1] + kinds[2] > 1;
        }
        return mixed;
    };
    CHECK(mixedNodes(BakeHierarchy::cluster) <= 8);
    CHECK(mixedNodes(BakeHierarchy::paper) > 100); // the control: it does not know of them
}

TEST_CASE("The nearest cluster is that of a loop over all") {
    std::vector<detail::Cluster> clusters;
    for (const Surfel& surfel : roomWithWall(1200)) {
        const auto i = uint32_t(clusters.size());
        detail::Cluster cluster;
        cluster.position = glm::dvec3(surfel.position);
        cluster.normal = glm::dvec3(surfel.normal) * (1.0 - 0.1 * (i % 3));
        cluster.open = glm::dvec3(surfel.normal) * (0.1 * (i % 7));
        cluster.prospect = cluster.position + glm::dvec3(surfel.normal) * (1.0 + i % 2);
        cluster.surfels = 1 + i * 7919 % 13;
        clusters.push_back(cluster);
    }
    const double diagonal = 8.0 * std::sqrt(3.0);
    const detail::ClusterTree tree(clusters, diagonal,
                                   {.normal = 0.1, .balance = 0.02, .open = 0.05, .prospect = 0.5});
    const auto distance = [&](const detail::Cluster& a, const detail::Cluster& b) {
        const glm::dvec3 off = (a.position - b.position) / diagonal, open = a.open - b.open;
        const glm::dvec3 prospect = (a.prospect - b.prospect) / diagonal;
        const double more = std::max(a.surfels, b.surfels), fewer = std::min(a.surfels, b.surfels);
        return glm::dot(off, off) + 0.1 * (1.0 - glm::dot(a.normal, b.normal)) +
               0.02 * (more - fewer) / more + 0.05 * glm::dot(open, open) +
               0.5 * glm::dot(prospect, prospect);
    };
    for (uint32_t i = 0; i < clusters.size(); ++i) {
        double least = std::numeric_limits<double>::infinity();
        for (uint32_t j = 0; j < clusters.size(); ++j)
            if (i != j) least = std::min(least, distance(clusters[i], clusters[j]));
        const detail::Neighbour found = tree.nearest(i);
        REQUIRE(found.index != i);
        // Single precision of numbers up to 1, added up seven times.
        CHECK(std::abs(double(found.distance) - least) < 1e-6);
        CHECK(std::abs(distance(clusters[i], clusters[found.index]) - least) < 1e-6);
    }
}

TEST_CASE("Trees are the same bits for any number of threads") {
    const std::vector<Surfel> surfels = roomWithWall(5000);
    for (const BakeHierarchy hierarchy : hierarchies) {
        const SurfelTree one = treeOf(surfels, hierarchy, 1);
        for (const int threads : {2, 5}) {
            const SurfelTree other = treeOf(surfels, hierarchy, threads);
            CHECK(other.order == one.order);
            CHECK(other.terms == one.terms);
            REQUIRE(other.nodes.size() == one.nodes.size());
            CHECK(std::memcmp(other.nodes.data(), one.nodes.data(), one.nodes.size() * sizeof(SurfelNode)) ==
                  0);
        }
    }
}

TEST_CASE("Surfels in one place, and in rows of equal and of growing gaps, make trees of few stages") {
    std::vector<Surfel> place(3000), row(3000);
    for (uint32_t i = 0; i < row.size(); ++i) {
        place[i].normal = row[i].normal = {0, 1, 0};
        place[i].area = row[i].area = 1.0f;
        row[i].position.x = float(i);
    }
    for (const std::vector<Surfel>& surfels : {place, row, growingRow(1500)})
        for (const BakeHierarchy hierarchy : hierarchies) checkStages(treeOf(surfels, hierarchy));
}

TEST_CASE("A tree that is a chain is balanced above its small parts") {
    const std::vector<Surfel> surfels = growingRow(1500);
    std::vector<detail::Cluster> clusters;
    for (const Surfel& surfel : surfels) {
        clusters.emplace_back();
        clusters.back().position = glm::dvec3(surfel.position);
        clusters.back().area = 1.0;
    }
    detail::Joins chain{{0, 1}};
    for (uint32_t i = 2; i < surfels.size(); ++i) chain.push_back({uint32_t(surfels.size()) + i - 2, i});
    const auto stages = [&](const detail::Joins& joins) {
        return detail::sumsOf(surfels.size(), joins).back().stage;
    };
    CHECK(stages(chain) > uint32_t(maximumBakeStages));
    const detail::Joins balanced = detail::rebalanced(clusters, chain, {});
    REQUIRE(balanced.size() == chain.size());
    CHECK(stages(balanced) <= uint32_t(maximumBakeStages));
    std::vector<int> parents(2 * surfels.size() - 1);
    for (uint32_t i = 0; i < balanced.size(); ++i)
        for (const uint32_t child : balanced[i]) {
            REQUIRE(child < surfels.size() + i);
            ++parents[child];
        }
    CHECK(std::count(parents.begin(), parents.end(), 1) == std::ptrdiff_t(parents.size()) - 1);
    // The first 256 of the chain stay as they were.
    for (uint32_t i = 0; i < 255; ++i) CHECK(balanced[i] == chain[i]);
}

TEST_CASE("Section surfels holds them in the order of the tree's leaves") {
    std::vector<Surfel> surfels = roomWithWall(70);
    for (uint32_t i = 0; i < surfels.size(); ++i) surfels[i].emission = glm::vec3(float(i % 5));
    const SurfelTree tree = treeOf(surfels, BakeHierarchy::cluster);
    const std::vector<uint32_t> section = packSurfels(tree, surfels);
    REQUIRE(section.size() == 7 * 128);
    for (uint32_t i = 0; i < 128; ++i) {
        const auto number = [&](uint32_t k) { return section[k * 128 + i]; };
        if (i >= 70) {
            for (uint32_t k = 0; k < 7; ++k) CHECK(number(k) == 0);
            continue;
        }
        const Surfel& surfel = surfels[tree.order[i]];
        CHECK(std::bit_cast<float>(number(0)) == surfel.position.x);
        CHECK(std::bit_cast<float>(number(1)) == surfel.position.y);
        CHECK(std::bit_cast<float>(number(2)) == surfel.position.z);
        CHECK(unpackOctahedral(number(3)) == surfel.normal); // axes are exact
        CHECK(std::bit_cast<float>(number(4)) == surfel.area);
        CHECK(std::abs(unpackAlbedo(number(5)).x - surfel.albedo.x) < 0.001f);
        CHECK(unpackEmission(number(6)) == surfel.emission);
    }
}

TEST_CASE("What makes no tree is refused, with a sentence that names it") {
    const auto error = [](const std::vector<Surfel>& surfels) {
        const auto tree = buildSurfelTree(surfels, BakeHierarchy::cluster);
        return tree ? "no error" : tree.error().message;
    };
    CHECK(error({}) == "surfels are 0; 1 to 16777216 were expected");
    std::vector<Surfel> surfels = roomWithWall(10);
    surfels[3].area = 0.0f;
    CHECK(error(surfels) == "surfels[3].area is 0.000000; a finite one of more than 0 was expected");
    surfels[3].area = 1.0f;
    surfels[4].position.z = std::numeric_limits<float>::quiet_NaN();
    CHECK(error(surfels) ==
          "surfels[4] has a position or direction that is not finite; finite numbers were expected");
}
