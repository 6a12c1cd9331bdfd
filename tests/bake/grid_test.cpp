// SPDX-License-Identifier: MIT
#include "cache_places.hpp"
#include "cell_table.hpp"
#include "grid_cells.hpp"
#include "receivers.hpp"

#include "rebound/embree/ray_caster.hpp"
#include "rooms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

using namespace rebound;
using namespace rebound::detail;

namespace {

struct Scene {
    BakeGeometry geometry;
    EmbreeRayCaster rays;
    explicit Scene(BakeGeometry g)
        : geometry(std::move(g)), rays(std::move(*EmbreeRayCaster::build(geometry))) {}

    ReceivingSides sides(const BakeSettings& settings) const {
        return findReceivingSides(geometry, rays, settings);
    }
    GridCells cells(const BakeSettings& settings, float shift = 0.0f) const {
        auto grid = chooseCells(geometry, sides(settings), settings, shift);
        REQUIRE_MESSAGE(grid, grid.error().message);
        return *grid;
    }
    std::vector<CachePlace> places(const GridCells& grid) const {
        return placeCaches({geometry, rays}, grid, 2);
    }
};

bool isInside(glm::vec3 p, glm::vec3 lower, glm::vec3 upper) {
    return glm::all(glm::greaterThan(p, lower)) && glm::all(glm::lessThan(p, upper));
}

// A hall of 8 x 4 x 8 m with a pillar of 1 m in its middle.
BakeGeometry hallWithPillar() {
    BakeGeometry geometry;
    addBox(geometry, {0, 0, 0}, {8, 4, 8}, true);
    addBox(geometry, {3.5f, 0.001f, 3.5f}, {4.5f, 3.999f, 4.5f}); // its ends are seen from nowhere
    return geometry;
}

} // namespace

TEST_CASE("the grid is as fine as the number of caches allows") {
    const Scene scene(hallWithPillar());
    for (const uint32_t caches : {8u, 100u, 1000u, 5000u}) {
        BakeSettings settings;
        settings.caches = caches;
        for (const float shift : {0.0f, 0.5f}) {
            const GridCells grid = scene.cells(settings, shift);
            CHECK(grid.corners.size() <= caches);
            // Spacings in which the walls lie across cells differently make jumps of that size.
            CHECK(double(grid.corners.size()) >= 0.7 * double(caches));
        }
    }
}

TEST_CASE("a spacing that asks for too many caches is refused with the memory it would take") {
    const Scene scene(closedBox());
    BakeSettings settings;
    settings.spacing = 2.0f * std::sqrt(94.0f / 2e9f); // of 94 m^2, about 10^9 caches at two each
    const auto grid = chooseCells(scene.geometry, scene.sides(settings), settings);
    REQUIRE(!grid);
    CHECK_MESSAGE(grid.error().message.find("settings.spacing") != std::string::npos, grid.error().message);
    CHECK_MESSAGE(grid.error().message.find("GiB") != std::string::npos, grid.error().message);
    CHECK_MESSAGE(grid.error().message.find("10000") != std::string::npos, grid.error().message);
    settings.spacing = 0.1f; // 18,000 caches
    CHECK(!chooseCells(scene.geometry, scene.sides(settings), settings));
    settings.spacing = 0.5f;
    const auto fits = chooseCells(scene.geometry, scene.sides(settings), settings);
    REQUIRE(fits);
    CHECK(fits->lattice.spacing == 0.5f);
}

TEST_CASE("no surface lies on the grid's border, and each point before one lies in a lit cell") {
    for (const float shift : {0.0f, 0.5f, -0.3f}) {
        const Scene scene(hallWithPillar());
        BakeSettings settings;
        settings.spacing = 0.5f; // unshifted, some walls lie in planes of the lattice
        const GridCells grid = scene.cells(settings, shift);
        const ReceivingSides sides = scene.sides(settings);
        for (const SurfaceSide& side : sides.sides) {
            const glm::vec3 at = grid.lattice.coordinates(side.position);
            for (int axis = 0; axis < 3; ++axis) {
                REQUIRE(at[axis] > 0.2f);
                REQUIRE(at[axis] < float(grid.lattice.cells[axis]) - 0.2f);
            }
            // Positions of receivers are wrong by a little, along the normal too.
            for (const float error : {-0.3f, 0.0f, 0.3f}) {
                const glm::vec3 moved =
                    side.position + side.normal * (grid.lattice.spacing * receiverOffset * (1.0f + error));
                REQUIRE(std::binary_search(grid.cells.begin(), grid.cells.end(),
                                           latticeKey(grid.lattice.cellAt(moved))));
            }
        }
    }
}

TEST_CASE("caches are out of geometry, and away from surfaces where there is room") {
    const Scene scene(hallWithPillar());
    BakeSettings settings;
    settings.caches = 1500;
    for (const float shift : {0.0f, 0.25f, 0.5f}) {
        const GridCells grid = scene.cells(settings, shift);
        const float spacing = grid.lattice.spacing;
        size_t moved = 0, invalid = 0, near = 0, valid = 0;
        const std::vector<CachePlace> places = scene.places(grid);
        for (size_t i = 0; i < places.size(); ++i) {
            const CachePlace& place = places[i];
            moved += place.isMoved;
            invalid += !place.isValid;
            if (!place.isValid) continue;
            ++valid;
            REQUIRE(isInside(place.position, {0, 0, 0}, {8, 4, 8}));
            REQUIRE(!isInside(place.position, {3.5f, -1, 3.5f}, {4.5f, 5, 4.5f}));
            REQUIRE(glm::distance(place.position, grid.lattice.corner(latticePlace(grid.corners[i]))) <
                    0.81f * spacing);
            float nearest = 100.0f;
            for (int axis = 0; axis < 3; ++axis)
                nearest = std::min(
                    {nearest, place.position[axis], (axis == 1 ? 4.0f : 8.0f) - place.position[axis]});
            near += nearest < 0.2f * spacing;
        }
        CHECK(moved > 0);
        CHECK(invalid < places.size() / 3);
        CHECK(double(near) < 0.05 * double(valid)); // those that would have had to move too far
    }
}

TEST_CASE("the back of a curtain does not make caches invalid") {
    BakeGeometry geometry = hallWithPillar();
    addQuad(geometry, {1, 0.5f, 1.5f}, {5, 0, 0}, {0, 3, 0}); // its back faces -z
    const Scene scene(std::move(geometry));
    BakeSettings settings;
    settings.caches = 2000;
    const GridCells grid = scene.cells(settings);
    const std::vector<CachePlace> places = scene.places(grid);
    size_t behind = 0;
    for (size_t i = 0; i < places.size(); ++i) {
        const glm::vec3 corner = grid.lattice.corner(latticePlace(grid.corners[i]));
        if (!isInside(corner, {1, 0.5f, 0.5f}, {6, 3.5f, 1.5f})) continue;
        ++behind;
        CHECK(places[i].isValid);
    }
    CHECK(behind > 10);
}

TEST_CASE("everywhere a cell is in effect: its own where that is lit, else one near it") {
    const Scene scene(hallWithPillar());
    BakeSettings settings;
    settings.caches = 3000;
    const GridCells grid = scene.cells(settings);
    const CellTable table = tabulateCells(grid, scene.places(grid));
    REQUIRE(table.cells.size() > 100);
    std::set<LatticeKey> lit;
    for (const Cell& cell : table.cells) lit.insert(cell.key);
    const auto cellAt = [&](glm::uvec3 place) {
        const glm::uvec3 brick = place / 4u, within = place % 4u;
        const uint32_t filled =
            table.brickOf.at(brick.x + table.bricks.x * (brick.y + table.bricks.y * brick.z));
        REQUIRE(filled < table.filledBricks);
        return table.cellOf.at(64 * filled + within.x + 4 * within.y + 16 * within.z);
    };
    for (uint32_t z = 0; z < 4 * table.bricks.z; ++z)
        for (uint32_t y = 0; y < 4 * table.bricks.y; ++y)
            for (uint32_t x = 0; x < 4 * table.bricks.x; ++x) {
                const uint32_t cell = cellAt({x, y, z});
                REQUIRE(cell < table.cells.size());
                if (lit.count(latticeKey({x, y, z}))) REQUIRE(table.cells[cell].key == latticeKey({x, y, z}));
                const auto& caches = table.cells[cell].caches;
                REQUIRE(std::any_of(caches.begin(), caches.end(),
                                    [&](uint32_t c) { return c < table.caches.size(); }));
            }
}

TEST_CASE("receivers on both sides of a wall see the caches of their own room alone") {
    const Scene scene(twoRooms(0.02f));
    BakeSettings settings;
    settings.caches = 400;
    const GridCells grid = scene.cells(settings);
    const CellTable table = tabulateCells(grid, scene.places(grid));
    const ReceivingSides sides = scene.sides(settings);
    const auto receivers = gatherReceivers({scene.geometry, scene.rays}, grid.lattice, table, sides.sides,
                                           samplesOfCells(grid.lattice, table.cells, sides.sides), 0,
                                           uint32_t(table.cells.size()));
    size_t atWall = 0, compared = 0, wrong = 0;
    for (size_t c = 0; c < table.cells.size(); ++c) {
        CHECK(receivers[c].size() <= 8);
        for (const Receiver& receiver : receivers[c]) {
            const float x = grid.lattice.corner(latticePlace(table.cells[c].key)).x +
                            receiver.position.x * grid.lattice.spacing;
            const bool isInFirst = x < 3.01f;
            if (std::abs(x - 3.01f) < 0.02f && std::abs(receiver.normal.x) > 0.9f) ++atWall;
            for (size_t k = 0; k < 8; ++k) {
                const uint32_t cache = table.cells[c].caches[k];
                if (cache == noCache) {
                    CHECK(receiver.visibility[k] == 0.0f);
                    continue;
                }
                const bool sameRoom = (table.caches[cache].x < 3.01f) == isInFirst;
                // From everywhere in a room all of it is seen. A receiver stands for samples of one room, but in a
                // corner of both rooms, where there are more kinds of samples than receivers.
                ++compared;
                wrong += receiver.visibility[k] != (sameRoom ? 1.0f : 0.0f);
            }
        }
    }
    CHECK(atWall > 20);
    CHECK(double(wrong) < 0.01 * double(compared));
}
