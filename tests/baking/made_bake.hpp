// SPDX-License-Identifier: MIT
// Bakes written by hand.
#pragma once

#include "rebound/bake/bake.hpp"
#include "rebound/bake/hierarchy.hpp"

#include <memory>
#include <vector>

namespace rebound::lab {

// One that holds surfels and nothing else.
inline Bake surfelsOnly(const std::vector<Surfel>& surfels) {
    SurfelTree tree;
    for (uint32_t i = 0; i < surfels.size(); ++i) tree.order.push_back(i);
    auto words = std::make_shared<const std::vector<uint32_t>>(packSurfels(tree, surfels));
    Bake bake;
    bake.layout.surfels = bake.layout.nodes = uint32_t(surfels.size());
    bake.sections[size_t(BakeSection::surfels)] = *words;
    bake.storage = std::move(words);
    return bake;
}

} // namespace rebound::lab
