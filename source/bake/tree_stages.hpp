// SPDX-License-Identifier: MIT
// In which order, and of which terms, nodes of a tree are summed up.
#pragma once

#include "joins.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rebound::detail {

inline constexpr uint32_t mostTerms = 8; // of a node

struct NodeSum {
    uint32_t stage = 0; // 0: a surfel, which is no sum
    uint32_t terms = 0;
    std::array<uint32_t, mostTerms> term{}; // clusters of lower stages
};

// Of each cluster, surfels first. A node is summed up together with its children wherever it has few enough terms then:
// so stages are few, and long thin branches take no more of them than bushy ones.
std::vector<NodeSum> sumsOf(size_t surfels, const Joins&);

} // namespace rebound::detail
