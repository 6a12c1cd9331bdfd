// SPDX-License-Identifier: MIT
#include "joins.hpp"

#include <cmath>

namespace rebound::detail {

Cluster joined(const Cluster& a, const Cluster& b) {
    Cluster both;
    both.area = a.area + b.area;
    both.surfels = a.surfels + b.surfels;
    const double share = b.area / both.area;
    both.position = glm::mix(a.position, b.position, share);
    both.normal = glm::mix(a.normal, b.normal, share);
    both.open = glm::mix(a.open, b.open, share);
    both.prospect = glm::mix(a.prospect, b.prospect, share);
    return both;
}

ClusterPoint pointOf(const Cluster& cluster, double diagonal, const ClusterWeights& weights) {
    const double scale = diagonal > 0.0 ? 1.0 / diagonal : 0.0;
    const std::array<glm::dvec3, 4> vectors{
        cluster.position * scale, cluster.normal * std::sqrt(0.5 * weights.normal),
        cluster.open * std::sqrt(weights.open), cluster.prospect * (scale * std::sqrt(weights.prospect))};
    ClusterPoint point;
    for (size_t i = 0; i < vectors.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) point[3 * i + size_t(axis)] = vectors[i][axis];
    return point;
}

double diagonalOf(std::span<const Cluster> clusters) {
    glm::dvec3 lower = clusters.front().position, upper = lower;
    for (const Cluster& cluster : clusters) {
        lower = glm::min(lower, cluster.position);
        upper = glm::max(upper, cluster.position);
    }
    return glm::length(upper - lower);
}

} // namespace rebound::detail
