// SPDX-License-Identifier: MIT
#include "joins.hpp"

#include <algorithm>
#include <numeric>

namespace rebound::detail {

namespace {

class Halving {
public:
    Halving(std::span<const Cluster> clusters, const ClusterWeights& weights) : order(clusters.size()) {
        std::iota(order.begin(), order.end(), 0u);
        points.reserve(clusters.size());
        const double diagonal = diagonalOf(clusters);
        for (const Cluster& cluster : clusters) points.push_back(pointOf(cluster, diagonal, weights));
    }

    // Joins the clusters first to last of the order, and returns what they become. As deep as the tree: log2 of them.
    uint32_t join(size_t first, size_t last) {
        if (last - first == 1) return order[first];
        const size_t middle = first + (last - first) / 2;
        const size_t axis = longestAxis(first, last);
        const auto at = [&](size_t i) { return order.begin() + std::ptrdiff_t(i); };
        std::nth_element(at(first), at(middle), at(last), [&](uint32_t a, uint32_t b) {
            const double left = points[a][axis], right = points[b][axis];
            return left != right ? left < right : a < b;
        });
        const uint32_t a = join(first, middle), b = join(middle, last);
        joins.push_back({a, b});
        return uint32_t(points.size() + joins.size() - 1);
    }

    Joins joins;

private:
    size_t longestAxis(size_t first, size_t last) const {
        ClusterPoint lower = points[order[first]], upper = lower;
        for (size_t i = first; i < last; ++i)
            for (size_t axis = 0; axis < lower.size(); ++axis) {
                lower[axis] = std::min(lower[axis], points[order[i]][axis]);
                upper[axis] = std::max(upper[axis], points[order[i]][axis]);
            }
        size_t longest = 0;
        for (size_t axis = 1; axis < lower.size(); ++axis)
            if (upper[axis] - lower[axis] > upper[longest] - lower[longest]) longest = axis;
        return longest;
    }

    std::vector<ClusterPoint> points;
    std::vector<uint32_t> order;
};

} // namespace

Joins joinHalves(std::span<const Cluster> clusters, const ClusterWeights& weights) {
    Halving halving(clusters, weights);
    halving.join(0, clusters.size());
    return std::move(halving.joins);
}

Joins rebalanced(std::span<const Cluster> clusters, const Joins& joins, const ClusterWeights& weights) {
    // Below these a tree is at most as many joins deep; above, as many as halves of 2^20 surfels are.
    constexpr uint32_t surfelsOfPart = 256;
    const auto count = uint32_t(clusters.size());
    std::vector<Cluster> all(clusters.begin(), clusters.end());
    std::vector<bool> isInside(clusters.size() + joins.size()); // of a part
    std::vector<uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    Joins result;
    for (const auto& [a, b] : joins) {
        all.push_back(joined(all[a], all[b]));
        numbers.push_back(count + uint32_t(result.size()));
        if (all.back().surfels > surfelsOfPart) continue;
        isInside[a] = isInside[b] = true;
        result.push_back({numbers[a], numbers[b]});
    }
    std::vector<Cluster> parts;
    std::vector<uint32_t> partNumbers;
    for (size_t i = 0; i < all.size(); ++i) {
        if (isInside[i] || all[i].surfels > surfelsOfPart) continue;
        parts.push_back(all[i]);
        partNumbers.push_back(numbers[i]);
    }
    const auto firstTop = uint32_t(count + result.size());
    const auto part = [&](uint32_t i) {
        return i < parts.size() ? partNumbers[i] : firstTop + i - uint32_t(parts.size());
    };
    for (const auto& [a, b] : joinHalves(parts, weights)) result.push_back({part(a), part(b)});
    return result;
}

} // namespace rebound::detail
