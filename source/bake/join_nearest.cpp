// SPDX-License-Identifier: MIT
#include "joins.hpp"

#include "cluster_tree.hpp"
#include "parallel.hpp"

#include <algorithm>
#include <tuple>

namespace rebound::detail {

namespace {

constexpr uint32_t alone = 0xffffffffu;

// Of each cluster the one that it joins: nearest to each other.
std::vector<uint32_t> mutualPartners(const std::vector<Neighbour>& nearest) {
    std::vector<uint32_t> partners(nearest.size(), alone);
    for (uint32_t i = 0; i < nearest.size(); ++i)
        if (nearest[nearest[i].index].index == i) partners[i] = nearest[i].index;
    return partners;
}

// Where few are nearest to each other, as in a row of growing gaps: each with its nearest, the closest first.
std::vector<uint32_t> greedyPartners(const std::vector<Neighbour>& nearest) {
    std::vector<uint32_t> order(nearest.size()), partners(nearest.size(), alone);
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return std::tie(nearest[a].distance, nearest[a].tieBreak, a) <
               std::tie(nearest[b].distance, nearest[b].tieBreak, b);
    });
    for (const uint32_t i : order) {
        const uint32_t other = nearest[i].index;
        if (partners[i] != alone || partners[other] != alone) continue;
        partners[i] = other;
        partners[other] = i;
    }
    return partners;
}

} // namespace

Joins joinNearest(std::span<const Cluster> clusters, const ClusterWeights& weights, int threads) {
    Joins joins;
    const double diagonal = diagonalOf(clusters);
    std::vector<Cluster> active(clusters.begin(), clusters.end());
    std::vector<uint32_t> numbers(clusters.size());
    for (uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
    while (active.size() > 1) {
        const ClusterTree tree(active, diagonal, weights);
        std::vector<Neighbour> nearest(active.size());
        parallelFor(active.size(), threads, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) nearest[i] = tree.nearest(uint32_t(i));
        });
        std::vector<uint32_t> partners = mutualPartners(nearest);
        constexpr size_t few = 16; // of so many, fewer than one joins
        if (const auto left = std::count(partners.begin(), partners.end(), alone);
            (active.size() - size_t(left)) * few < active.size())
            partners = greedyPartners(nearest);
        size_t kept = 0;
        for (uint32_t i = 0; i < partners.size(); ++i) {
            if (partners[i] < i) continue; // it has joined
            Cluster cluster = active[i];
            uint32_t number = numbers[i];
            if (partners[i] != alone) {
                cluster = joined(active[i], active[partners[i]]);
                number = uint32_t(clusters.size() + joins.size());
                joins.push_back({numbers[i], numbers[partners[i]]});
            }
            active[kept] = cluster;
            numbers[kept++] = number;
        }
        active.resize(kept);
        numbers.resize(kept);
    }
    return joins;
}

} // namespace rebound::detail
