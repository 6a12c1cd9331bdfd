// SPDX-License-Identifier: MIT
#include "rebound/bake/bake.hpp"

#include "rooms.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace rebound;

namespace {

using Sections = std::array<std::vector<uint32_t>, bakeSectionCount>;

// A bake whose numbers can be changed.
struct OpenBake {
    BakeLayout layout;
    Sections sections;

    explicit OpenBake(const Bake& bake) : layout(bake.layout) {
        for (size_t i = 0; i < sections.size(); ++i)
            sections[i].assign(bake.sections[i].begin(), bake.sections[i].end());
    }
    std::vector<uint32_t>& operator[](BakeSection section) { return sections[size_t(section)]; }
    Result<> validated() const {
        Bake bake;
        bake.layout = layout;
        for (size_t i = 0; i < sections.size(); ++i) bake.sections[i] = sections[i];
        return validate(bake);
    }
};

void checkRefused(const OpenBake& good, const std::string& named,
                  const std::function<void(OpenBake&)>& spoil) {
    OpenBake bad = good;
    spoil(bad);
    const auto result = bad.validated();
    REQUIRE_MESSAGE(!result, named, " was taken");
    CHECK_MESSAGE(result.error().message.find(named) != std::string::npos, result.error().message);
}

} // namespace

TEST_CASE("a bake's numbers lie in their ranges, or it is refused and they are named") {
    BakeSettings settings = smallSettings();
    settings.lightMap = 100;
    const OpenBake good{bakeOf(closedBox(), settings)};
    REQUIRE(good.validated());
    const BakeLayout& l = good.layout;
    REQUIRE(l.stages > 1);
    REQUIRE(l.receivers > 0);
    const auto change = [&](BakeSection section, size_t index, uint32_t value) {
        checkRefused(good, name(section), [&](OpenBake& bad) { bad[section].at(index) = value; });
    };
    const uint32_t infinity = 0x7f800000u, minusOne = 0xbf800000u;
    change(BakeSection::linkNodes, 5, l.nodes + 1);
    change(BakeSection::linkNodes, good.sections[size_t(BakeSection::linkNodes)].size() - 1,
           0xffffffffu); // padding
    change(BakeSection::linkFactors, 7, infinity);
    change(BakeSection::linkFactors, 7, minusOne);
    change(BakeSection::surfels, 3, infinity);
    change(BakeSection::places, 2, infinity);
    change(BakeSection::bricks, 0, l.filledBricks);
    change(BakeSection::brickCells, 9, l.cells);
    change(BakeSection::cells, 12 * (l.cells - 1), l.gridCaches());
    change(BakeSection::mapTexels, 3, l.caches);
    change(BakeSection::mapTexels, 3, l.gridCaches() - 1);
    change(BakeSection::terms, 0, l.stage[0].firstNode); // a node of its own stage
    change(BakeSection::terms, l.stage[1].firstTerm, l.nodes + 1);
    checkRefused(good, "place of cell", [&](OpenBake& bad) { bad[BakeSection::cells][8] = 4 * l.bricks.x; });
    checkRefused(good, "last receiver of cell",
                 [&](OpenBake& bad) { bad[BakeSection::cells][10] = 0xffffffffu; });
    checkRefused(good, "area of surfel", [&](OpenBake& bad) {
        bad[BakeSection::surfels][4 * BakeLayout::stride(l.surfels)] = minusOne;
    });
    // The empty node sends nothing, so anything may name it; none is no cache.
    OpenBake empty = good;
    empty[BakeSection::linkNodes][5] = l.nodes;
    empty[BakeSection::terms][l.stage[1].firstTerm] = l.nodes;
    empty[BakeSection::cells][12 * (l.cells - 1)] = 0xffffffffu;
    CHECK(empty.validated());
}

TEST_CASE("a layout's counts lie in their ranges, or the bake is refused and they are named") {
    const OpenBake good{bakeOf(closedBox())};
    const auto spoil = [&](const std::string& named, const std::function<void(BakeLayout&)>& change) {
        checkRefused(good, named, [&](OpenBake& bad) { change(bad.layout); });
    };
    spoil("surfels", [](BakeLayout& l) { l.surfels = 0; });
    spoil("nodes", [](BakeLayout& l) { l.nodes = 2 * l.surfels; });
    spoil("stages", [](BakeLayout& l) { l.stages = maximumBakeStages + 1; });
    spoil("nodes in stages", [](BakeLayout& l) { --l.stages; });
    spoil("stage 1's first node", [](BakeLayout& l) { ++l.stage[1].firstNode; });
    spoil("stage 1's number of terms", [](BakeLayout& l) { l.stage[1].terms = 9; });
    spoil("stage 1's first term", [](BakeLayout& l) { l.stage[1].firstTerm += 64; });
    spoil("caches", [](BakeLayout& l) { l.caches = 0; });
    spoil("links", [](BakeLayout& l) { l.links = 4097; });
    spoil("bands", [](BakeLayout& l) { l.bands = 5; });
    spoil("form of links", [](BakeLayout& l) { l.linkForm = LinkForm(2); });
    spoil("bricks", [](BakeLayout& l) { l.bricks.y = 257; });
    spoil("filled bricks", [](BakeLayout& l) { l.filledBricks = 1u << 30; });
    spoil("cells", [](BakeLayout& l) { l.cells = 0; });
    spoil("receivers", [](BakeLayout& l) { l.receivers = 0xffffffffu; });
    spoil("spacing", [](BakeLayout& l) { l.spacing = 0.0f; });
    spoil("surface caches", [](BakeLayout& l) { l.surfaceCaches = l.caches; });
    spoil("light map's width", [](BakeLayout& l) { l.mapSize.x = 9; });
    spoil("light map's row", [](BakeLayout& l) { l.mapBackRow = 1; });
    spoil("mapped triangles", [](BakeLayout& l) { l.mapTriangles = 12; });
    spoil("light map's texel", [](BakeLayout& l) { l.mapTexel = 1.0f; });
    spoil("origin", [](BakeLayout& l) { l.origin.z = std::numeric_limits<float>::quiet_NaN(); });
    spoil("section linkShapes", [](BakeLayout& l) { l.bands = 2; });
    spoil("section cells", [](BakeLayout& l) { --l.cells; });
}
