// SPDX-License-Identifier: MIT
#include "tree_stages.hpp"

#include <algorithm>

namespace rebound::detail {

namespace {

// All nodes of a stage have room for as many terms as its fullest node. Where most nodes are, fewer terms leave less of it
// empty: of 33,000 surfels in 7 stages, 141,000 terms instead of 264,000; with four terms everywhere 132,000 in 11 stages.
uint32_t mostTermsIn(uint32_t stage) { return stage <= 2 ? 4 : mostTerms; }

// What a child contributes to a sum of that stage.
uint32_t termsIn(const NodeSum& child, uint32_t stage) { return child.stage < stage ? 1 : child.terms; }

void append(NodeSum& sum, const std::vector<NodeSum>& all, uint32_t child) {
    if (all[child].stage < sum.stage) sum.term[sum.terms++] = child;
    else
        for (uint32_t i = 0; i < all[child].terms; ++i) sum.term[sum.terms++] = all[child].term[i];
}

} // namespace

std::vector<NodeSum> sumsOf(size_t surfels, const Joins& joins) {
    std::vector<NodeSum> sums(surfels);
    sums.reserve(surfels + joins.size());
    for (const auto& [a, b] : joins) {
        NodeSum sum;
        sum.stage = std::max({1u, sums[a].stage, sums[b].stage});
        if (termsIn(sums[a], sum.stage) + termsIn(sums[b], sum.stage) > mostTermsIn(sum.stage)) ++sum.stage;
        append(sum, sums, a);
        append(sum, sums, b);
        sums.push_back(sum);
    }
    return sums;
}

} // namespace rebound::detail
