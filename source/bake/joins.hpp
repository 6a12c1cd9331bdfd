// SPDX-License-Identifier: MIT
// Which surfels send light together: the order in which clusters of them join.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rebound::detail {

struct Cluster {
    glm::dvec3 position{0.0}; // mean by area [m]
    glm::dvec3 normal{0.0};   // mean by area
    glm::dvec3 open{0.0};     // mean by area of Surfel::open
    glm::dvec3 prospect{0.0}; // mean by area of Surfel::prospect [m]
    double area = 0.0;        // [m^2]
    uint32_t surfels = 1;
};

Cluster joined(const Cluster&, const Cluster&);

// How much counts, beside places over the scene's diagonal, in the distance between clusters:
//   |x_a - x_b|^2 / diagonal^2 + normal (1 - n_a . n_b) + balance |A_a - A_b| / max(A_a, A_b)        [PIC, sec. 4.3]
//       + open |o_a - o_b|^2 + prospect |p_a - p_b|^2 / diagonal^2
// The last two are ours: links take a cluster for evenly bright, so what light reaches by other ways is to stay apart.
// Without prospects the floors on both sides of a wall join, and what lights one shines from the other (the paper's figure
// 7c).
struct ClusterWeights {
    double normal = 0.1;   // C_n
    double balance = 0.02; // C_b
    double open = 0.0;
    double prospect = 0.0;
};

// In which the squared distance of two surfels is all of the above but the balance: place over the diagonal, normal times
// sqrt(C_n / 2), the open, prospect.
using ClusterPoint = std::array<double, 12>;
ClusterPoint pointOf(const Cluster&, double diagonal, const ClusterWeights&);

// Of the box around all places [m].
double diagonalOf(std::span<const Cluster>);

// Join k makes cluster n + k of two earlier ones, n the number of clusters to begin with; n - 1 joins make one of all.
using Joins = std::vector<std::array<uint32_t, 2>>;

// The two nearest. Pairs that are nearest to each other join at the same
// time, which gives the tree of joining one pair at a time wherever a new cluster is no nearer to others than both its
// parts were. The same for any number of threads.
Joins joinNearest(std::span<const Cluster>, const ClusterWeights&, int threads);

// Halves by number along the axis in which their points are furthest apart: a k-d tree that tells sides of a wall apart.
// Precondition: there are clusters.
Joins joinHalves(std::span<const Cluster>, const ClusterWeights&);

// The same joins below clusters of few surfels, and halves of those above: a tree that is nowhere deep.
Joins rebalanced(std::span<const Cluster>, const Joins&, const ClusterWeights&);

} // namespace rebound::detail
