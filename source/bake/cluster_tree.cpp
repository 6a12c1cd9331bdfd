// SPDX-License-Identifier: MIT
#include "cluster_tree.hpp"

#include "sequence.hpp"

#include <algorithm>
#include <limits>

namespace rebound::detail {

namespace {

constexpr uint32_t itemsOfLeaf = 8;

} // namespace

ClusterTree::ClusterTree(std::span<const Cluster> clusters, double diagonal, const ClusterWeights& weights)
    : balance(float(weights.balance)) {
    items.resize(clusters.size());
    // Counted from one of them, places lose no digits in single precision.
    const ClusterPoint origin = pointOf(clusters.front(), diagonal, weights);
    for (uint32_t i = 0; i < clusters.size(); ++i) {
        const Cluster& cluster = clusters[i];
        const ClusterPoint point = pointOf(cluster, diagonal, weights);
        for (size_t axis = 0; axis < dimensions; ++axis)
            items[i].point[axis] = float(point[axis] - origin[axis]);
        const double lack = 0.5 * weights.normal * (1.0 - glm::dot(cluster.normal, cluster.normal));
        items[i].lack = float(std::max(0.0, lack));
        items[i].surfels = float(cluster.surfels);
        items[i].index = i;
    }
    size_t count = 1;
    while (items.size() > count * itemsOfLeaf) count *= 2;
    boxes.resize(2 * count - 1);
    boxes[0].last = uint32_t(items.size());
    for (uint32_t i = 0; i < boxes.size(); ++i) split(i);
    places.resize(items.size());
    for (uint32_t i = 0; i < items.size(); ++i) places[items[i].index] = i;
}

void ClusterTree::split(uint32_t number) {
    Box& box = boxes[number];
    box.lower.fill(std::numeric_limits<float>::infinity());
    box.upper.fill(-std::numeric_limits<float>::infinity());
    box.fewest = std::numeric_limits<float>::infinity();
    for (uint32_t i = box.first; i < box.last; ++i) {
        for (size_t axis = 0; axis < dimensions; ++axis) {
            box.lower[axis] = std::min(box.lower[axis], items[i].point[axis]);
            box.upper[axis] = std::max(box.upper[axis], items[i].point[axis]);
        }
        box.fewest = std::min(box.fewest, items[i].surfels);
        box.most = std::max(box.most, items[i].surfels);
    }
    if (2 * size_t(number) + 2 >= boxes.size()) return;
    size_t longest = 0;
    for (size_t axis = 1; axis < dimensions; ++axis)
        if (box.upper[axis] - box.lower[axis] > box.upper[longest] - box.lower[longest]) longest = axis;
    const uint32_t middle = box.first + (box.last - box.first) / 2;
    std::nth_element(items.begin() + box.first, items.begin() + middle, items.begin() + box.last,
                     [&](const Item& a, const Item& b) {
                         return a.point[longest] != b.point[longest] ? a.point[longest] < b.point[longest]
                                                                     : a.index < b.index;
                     });
    boxes[2 * size_t(number) + 1].first = box.first;
    boxes[2 * size_t(number) + 1].last = middle;
    boxes[2 * size_t(number) + 2].first = middle;
    boxes[2 * size_t(number) + 2].last = box.last;
}

// The paper compares areas, which are numbers of surfels there as all are of one size. Here areas of neighbours differ
// by chance, and would outweigh places.
float ClusterTree::imbalance(float fewer, float more) const { return balance * (more - fewer) / more; }

// With 2 (1 - n_a . n_b) = |n_a - n_b|^2 + (1 - |n_a|^2) + (1 - |n_b|^2).
float ClusterTree::distance(const Item& a, const Item& b) const {
    float sum = a.lack + b.lack + imbalance(std::min(a.surfels, b.surfels), std::max(a.surfels, b.surfels));
    for (size_t axis = 0; axis < dimensions; ++axis) {
        const float off = a.point[axis] - b.point[axis];
        sum += off * off;
    }
    return sum;
}

// The least distance that anything in the box can have.
float ClusterTree::bound(const Item& a, const Box& box) const {
    float sum = a.lack;
    for (size_t axis = 0; axis < dimensions; ++axis) {
        const float off = std::max({box.lower[axis] - a.point[axis], a.point[axis] - box.upper[axis], 0.0f});
        sum += off * off;
    }
    if (a.surfels < box.fewest) return sum + imbalance(a.surfels, box.fewest);
    return a.surfels > box.most ? sum + imbalance(box.most, a.surfels) : sum;
}

Neighbour ClusterTree::nearest(uint32_t index) const {
    const Item& item = items[places[index]];
    Neighbour best{std::numeric_limits<float>::infinity(), 0, index};
    const auto look = [&](const Box& box) {
        for (uint32_t i = box.first; i < box.last; ++i) {
            const Item& other = items[i];
            const float off = distance(item, other);
            if (other.index == index || off > best.distance) continue;
            const uint64_t chance =
                hash(uint64_t(std::min(index, other.index)) << 32 | std::max(index, other.index));
            if (off == best.distance && chance >= best.tieBreak) continue;
            best = {off, chance, other.index};
        }
    };
    // Rounding may put a bound above a distance by some of its last digits.
    constexpr float rounding = 1.0f - 8.0f * std::numeric_limits<float>::epsilon();
    struct Pending {
        uint32_t box;
        float bound;
    };
    std::array<Pending, 64> pending; // one a level of the tree at most
    size_t count = 0;
    pending[count++] = {0, 0.0f};
    while (count > 0) {
        const Pending next = pending[--count];
        if (next.bound * rounding > best.distance) continue;
        const uint32_t left = 2 * next.box + 1, right = left + 1;
        if (right >= boxes.size()) {
            look(boxes[next.box]);
            continue;
        }
        const Pending a{left, bound(item, boxes[left])}, b{right, bound(item, boxes[right])};
        pending[count++] = a.bound < b.bound ? b : a;
        pending[count++] = a.bound < b.bound ? a : b;
    }
    return best;
}

} // namespace rebound::detail
