// SPDX-License-Identifier: MIT
#include "lab/baking/surfel_lookup.hpp"

#include "made_bake.hpp"

#include <doctest/doctest.h>

#include <set>

namespace rebound::lab {
namespace {

// Four surfels in a row, and a tree of two stages over them: (0 1) (2 3), then all.
Bake fourInTwoStages() {
    std::vector<Surfel> surfels;
    for (int i = 0; i < 4; ++i) surfels.push_back({{float(i), 0, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.5f), {}});
    Bake bake = surfelsOnly(surfels);
    bake.layout.nodes = 7;
    bake.layout.stages = 2;
    bake.layout.stage[0] = {4, 2, 2, 0};
    bake.layout.stage[1] = {6, 1, 2, 128};
    auto terms = std::make_shared<std::vector<uint32_t>>(256, 7u);
    (*terms)[0] = 0;
    (*terms)[64] = 1;
    (*terms)[1] = 2;
    (*terms)[65] = 3;
    (*terms)[128] = 4;
    (*terms)[192] = 5;
    bake.sections[size_t(BakeSection::terms)] = *terms;
    bake.storage = std::make_shared<std::pair<std::shared_ptr<const void>, std::shared_ptr<const void>>>(
        bake.storage, terms);
    return bake;
}

} // namespace

TEST_CASE("the nearest surfel of a side is found, and none that is far off or turned away") {
    const SurfelLookup lookup(fourInTwoStages());
    CHECK(lookup.nearest({1.2f, 0, 0}, {0, 1, 0}) == 1u);
    CHECK(lookup.nearest({1.8f, 0.1f, 0.1f}, {0, 1, 0}) == 2u);
    CHECK_FALSE(lookup.nearest({1.2f, 0, 0}, {0, -1, 0}));
    CHECK_FALSE(lookup.nearest({1.2f, 9, 0}, {0, 1, 0}));
}

TEST_CASE("patches hold every surfel once, as many as were asked for") {
    const Bake bake = fourInTwoStages();
    const std::vector<LeafRange> ranges = leafRanges(bake);
    REQUIRE(ranges.size() == 7);
    CHECK(ranges[5].first == 2);
    CHECK(ranges[5].last == 3);
    CHECK(ranges[6].first == 0);
    CHECK(ranges[6].last == 3);
    CHECK(patchesOf(bake, ranges, 1) == std::vector<uint32_t>{6, 6, 6, 6});
    CHECK(patchesOf(bake, ranges, 2) == std::vector<uint32_t>{4, 4, 5, 5});
    CHECK(patchesOf(bake, ranges, 4) == std::vector<uint32_t>{0, 1, 2, 3});
    CHECK(patchesOf(bake, ranges, 100) == std::vector<uint32_t>{0, 1, 2, 3});
}

} // namespace rebound::lab
