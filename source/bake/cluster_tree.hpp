// SPDX-License-Identifier: MIT
// Finds the cluster that is nearest to another.
#pragma once

#include "joins.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace rebound::detail {

// Pairs are ordered by distance, and equal ones by chance: of a row of equal distances, each with the next, only one
// pair would join at a time.
struct Neighbour {
    float distance = 0.0f; // that of ClusterWeights
    uint64_t tieBreak = 0;
    uint32_t index = 0;
};

// A k-d tree over clusters' points.
class ClusterTree {
public:
    // Precondition: at least two clusters; the diagonal of all is not negative [m].
    ClusterTree(std::span<const Cluster>, double diagonal, const ClusterWeights&);

    // Of another one than itself, by index into the clusters.
    Neighbour nearest(uint32_t index) const;

private:
    static constexpr size_t dimensions = std::tuple_size_v<ClusterPoint>;
    using Point = std::array<float, dimensions>; // pointOf(), from the first cluster on
    struct Item {
        Point point;
        float lack = 0.0f; // C_n / 2 (1 - |n|^2): what normals that cancel add to every distance
        float surfels = 1.0f;
        uint32_t index = 0;
    };
    struct Box {
        Point lower, upper;
        float fewest = 0.0f, most = 0.0f; // surfels of a cluster
        uint32_t first = 0, last = 0;     // items
    };

    void split(uint32_t box);
    float distance(const Item&, const Item&) const;
    float bound(const Item&, const Box&) const;
    float imbalance(float fewer, float more) const;

    float balance; // its weight

    std::vector<Item> items;
    std::vector<Box> boxes;       // the halves of box i are 2 i + 1 and 2 i + 2
    std::vector<uint32_t> places; // of clusters among items
};

} // namespace rebound::detail
