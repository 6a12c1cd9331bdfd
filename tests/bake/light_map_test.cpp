// SPDX-License-Identifier: MIT
#include "light_map.hpp"

#include "baked_light.hpp"
#include "light_map_packing.hpp"
#include "rooms.hpp"
#include "triangle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

using namespace rebound;
using namespace rebound::detail;

namespace {

BakeSettings mapSettings(uint32_t caches) {
    BakeSettings settings = smallSettings();
    settings.lightMap = caches;
    settings.links = 64;
    return settings;
}

// Whether all four texels that are read between at a place belong to a chart.
bool isFilled(const BakedLight& light, glm::dvec2 place) {
    const glm::ivec2 first(glm::floor(place - 0.5));
    for (int corner = 0; corner < 4; ++corner)
        if (light.mapTexel(first + glm::ivec2(corner & 1, corner >> 1)) == BakeLayout::noMapTexel)
            return false;
    return true;
}

// Of places on every triangle, a few of them on its edges.
template <class Body>
void forPlacesOn(const BakeGeometry& geometry, const Body& body) {
    for (uint32_t t = 0; t < geometry.triangles(); ++t)
        for (const double u : {0.0, 0.11, 0.37, 0.62, 0.95})
            for (const double v : {0.0, 0.08, 0.43, 0.71})
                if (u + v <= 1.0) body(t, glm::dvec2(u, v));
}

// A room in which a closed box stands, which nothing of the floor below it sees.
BakeGeometry furnishedRoom() {
    BakeGeometry geometry = closedBox();
    addBox(geometry, {1.3f, -0.1f, 1.6f}, {2.45f, 1.2f, 3.15f});
    return geometry;
}

bool isInBox(glm::vec3 p) { return p.x > 1.29f && p.x < 2.46f && p.z > 1.59f && p.z < 3.16f && p.y < 1.21f; }

// Triangles to both sides of each edge of a closed mesh, and the edge's middle in the barycentrics of both.
struct SharedEdge {
    uint32_t triangles[2];
    glm::dvec2 middles[2];
};
std::vector<SharedEdge> sharedEdges(const BakeGeometry& geometry) {
    constexpr double half = 0.5;
    const glm::dvec2 middles[3] = {{half, 0}, {half, half}, {0, half}};
    std::map<std::pair<uint32_t, uint32_t>, std::pair<uint32_t, glm::dvec2>> open;
    std::vector<SharedEdge> shared;
    for (uint32_t t = 0; t < geometry.triangles(); ++t)
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t a = geometry.indices[3 * t + i], b = geometry.indices[3 * t + (i + 1) % 3];
            if (const auto other = open.find({b, a}); other != open.end())
                shared.push_back({{other->second.first, t}, {other->second.second, middles[i]}});
            else open[{a, b}] = {t, middles[i]};
        }
    return shared;
}

} // namespace

TEST_CASE("rectangles are packed without overlap, the same each time") {
    std::vector<glm::ivec2> sizes;
    for (int i = 0; i < 500; ++i) sizes.push_back({1 + i * 7 % 23, 1 + i * i % 17});
    const auto packed = packRectangles(sizes, 512);
    REQUIRE(packed);
    std::vector<int> covered(size_t(packed->size.x) * size_t(packed->size.y));
    int area = 0;
    for (size_t i = 0; i < sizes.size(); ++i) {
        area += sizes[i].x * sizes[i].y;
        const glm::ivec2 corner = packed->corners[i];
        REQUIRE(corner.x + sizes[i].x <= packed->size.x);
        REQUIRE(corner.y + sizes[i].y <= packed->size.y);
        for (int y = 0; y < sizes[i].y; ++y)
            for (int x = 0; x < sizes[i].x; ++x)
                ++covered[size_t(corner.y + y) * size_t(packed->size.x) + size_t(corner.x + x)];
    }
    CHECK(std::count(covered.begin(), covered.end(), 1) == area);
    CHECK(packed->size.x * packed->size.y < 3 * area / 2);
    CHECK(packed->corners == packRectangles(sizes, 512)->corners);
    // Equal ones lie in the order of their numbers.
    const auto equal = packRectangles(std::vector<glm::ivec2>(9, {3, 3}), 9);
    REQUIRE(equal);
    CHECK(equal->corners[1] == glm::ivec2(3, 0));
    CHECK(equal->corners[3] == glm::ivec2(0, 3));
    CHECK(!packRectangles(std::vector<glm::ivec2>(10, {3, 3}), 9));
    CHECK(!packRectangles({{10, 1}}, 9));
}

TEST_CASE("every triangle is in one chart, with those that go on from it and face alike") {
    BakeGeometry geometry = closedBox();
    addSphere(geometry, {2, 1.5f, 2.5f}, 0.5f, 20);
    const std::vector<Chart> charts = growCharts(geometry, 0.1);
    std::vector<int> times(geometry.triangles());
    size_t flat = 0;
    for (const Chart& chart : charts) {
        flat += chart.triangles.size() == 2 && chart.area > 10.0;
        for (const uint32_t t : chart.triangles) {
            ++times[t];
            // 37 degrees, or 70 of small charts that were joined.
            const double least = chart.area > 0.05 ? 0.35 : 0.8;
            CHECK(glm::dot(Triangle(geometry, t).normal(), chart.frame.normal) >= least);
        }
    }
    for (uint32_t t = 0; t < geometry.triangles(); ++t)
        CHECK(times[t] == (Triangle(geometry, t).area() > 0.0 ? 1 : 0)); // at the poles two corners are one
    CHECK(flat == 6);                                                    // walls, whole
    CHECK(charts.size() < 40);
    for (const Chart& chart : charts) CHECK(chart.area > 0.01); // a texel: smaller ones found others beside
}

TEST_CASE("a ramp that winds up over itself is several charts") {
    BakeGeometry ramp;
    constexpr int steps = 96; // three turns
    for (int i = 0; i <= steps; ++i) {
        const float angle = 6.2831853f * float(i) / 32.0f, height = 0.03f * float(i);
        const glm::vec3 out(std::cos(angle), 0, -std::sin(angle));
        ramp.positions.push_back(out + glm::vec3(0, height, 0));
        ramp.positions.push_back(2.0f * out + glm::vec3(0, height, 0));
    }
    for (uint32_t i = 0; i < steps; ++i)
        for (const uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) ramp.indices.push_back(2 * i + corner);
    const std::vector<Chart> charts = growCharts(ramp, 0.1);
    CHECK(charts.size() >= 3);
    for (const Chart& chart : charts) CHECK(chart.area < 1.2 * 3.14159 * 3.0); // a turn, of radius 1 to 2
}

TEST_CASE("caches lie on surfaces, one a texel, and every read finds four of them") {
    const BakeGeometry geometry = furnishedRoom();
    for (const uint32_t wanted : {150u, 1500u}) {
        const Bake bake = bakeOf(geometry, mapSettings(wanted));
        CHECK(double(bake.layout.surfaceCaches) == doctest::Approx(double(wanted)).epsilon(0.2));
        const BakedLight light(bake, [](glm::vec3, glm::vec3) { return 1.0; });
        forPlacesOn(geometry, [&](uint32_t t, glm::dvec2 barycentrics) {
            const Triangle triangle(geometry, t);
            // The bottom of the box, below the floor, sees nothing.
            if (triangle.normal().y < -0.5 && triangle.corner[0].y < 0.0) return;
            REQUIRE(light.isInMap(t));
            const glm::dvec2 place = light.mapPlace(t, barycentrics);
            REQUIRE(place.x >= 0.5);
            REQUIRE(place.y >= 0.5);
            REQUIRE(isFilled(light, place));
            const uint32_t cache = light.mapTexel(glm::ivec2(place)) & BakeLayout::noMapCache;
            if (cache == BakeLayout::noMapCache) return;
            const glm::dvec3 position = triangle.at(barycentrics);
            const glm::dvec3 off = glm::dvec3(light.place(cache)) - position;
            // On that side of its plane; and near, where none was mended.
            CHECK(glm::dot(off, triangle.normal()) > 0.0);
            if (light.mapTexel(glm::ivec2(place)) >> 24 == 0)
                CHECK(glm::length(off) < 0.8 * double(bake.layout.mapTexel));
        });
    }
}

TEST_CASE("constant radiance arrives as it is on every surface; places inside of others are mended") {
    const BakeGeometry geometry = furnishedRoom();
    for (const bool mend : {true, false}) {
        const Bake bake = bakeOf(geometry, mapSettings(700), 0.0f, {mend, true});
        const BakedLight light(bake, [](glm::vec3, glm::vec3) { return 1.0; });
        size_t inBox = 0;
        for (uint32_t cache = bake.layout.gridCaches(); cache < bake.layout.caches; ++cache) {
            const glm::vec3 p = light.place(cache);
            inBox += p.x > 1.31f && p.x < 2.44f && p.z > 1.61f && p.z < 3.14f && p.y < 1.19f;
        }
        if (mend) CHECK(inBox == 0);
        else CHECK(inBox > 10); // as in fig. 7a
        if (!mend) continue;
        forPlacesOn(geometry, [&](uint32_t t, glm::dvec2 barycentrics) {
            const Triangle triangle(geometry, t);
            const glm::vec3 position(triangle.at(barycentrics)), normal(triangle.normal());
            if (position.y < 0.02f && (normal.y < 0.5f || isInBox(position))) return; // nobody sees it
            if (position.y < 0.3f && normal.y < 0.5f && isInBox(position)) return; // texels cross the floor
            // Half the sphere is known exactly; bands left out and rounded shapes leave a hundredth.
            CHECK(std::abs(light.atMap(light.mapPlace(t, barycentrics), normal) - 1.0) < 0.02);
        });
    }
}

TEST_CASE("what stands on a floor without a bottom does not darken the floor before it") {
    BakeGeometry geometry = closedBox();
    addQuad(geometry, {1.33f, 0, 3}, {1.1f, 0, 0}, {0, 1, 0}); // sides of a box, and its top
    addQuad(geometry, {2.43f, 0, 3}, {0, 0, -1.2f}, {0, 1, 0});
    addQuad(geometry, {2.43f, 0, 1.8f}, {-1.1f, 0, 0}, {0, 1, 0});
    addQuad(geometry, {1.33f, 0, 1.8f}, {0, 0, 1.2f}, {0, 1, 0});
    addQuad(geometry, {1.33f, 1, 3}, {1.1f, 0, 0}, {0, 0, -1.2f});
    double worst[2] = {0.0, 0.0};
    for (const bool mend : {true, false}) {
        const Bake bake = bakeOf(geometry, mapSettings(700), 0.0f, {mend, true});
        // Nothing is lit in the box.
        const BakedLight light(bake, [](glm::vec3 p, glm::vec3 n) {
            const glm::vec3 before = p + 0.01f * n;
            const bool isInside =
                before.x > 1.33f && before.x < 2.43f && before.z > 1.8f && before.z < 3.0f && before.y < 1.0f;
            return isInside ? 0.0 : 1.0;
        });
        for (uint32_t t = 0; t < 12; ++t) {
            const Triangle floor(geometry, t);
            if (floor.normal().y < 0.5) continue;
            for (double u = 0.01; u < 1.0; u += 0.02)
                for (double v = 0.01; u + v < 1.0; v += 0.02) {
                    const glm::vec3 p(floor.at({u, v}));
                    if (p.x > 1.31f && p.x < 2.45f && p.z > 1.78f && p.z < 3.02f) continue;
                    const double error = std::abs(light.atMap(light.mapPlace(t, {u, v}), {0, 1, 0}) - 1.0);
                    worst[mend ? 0 : 1] = std::max(worst[mend ? 0 : 1], error);
                }
        }
    }
    CHECK(worst[0] < 0.02); // bands left out and rounded shapes
    CHECK(worst[1] > 0.2);
}

TEST_CASE("charts agree at their seams where the surface is smooth") {
    BakeGeometry geometry;
    addSphere(geometry, {2, 1.5f, 2.5f}, 0.9f, 40);
    const std::vector<SharedEdge> edges = sharedEdges(geometry);
    const uint32_t ofSphere = geometry.triangles();
    addBox(geometry, {0, 0, 0}, {4, 3, 5}, true);
    const auto radiance = [](glm::vec3 p, glm::vec3) { return 1.0 + double(p.x) + (p.y > 1.5f ? 3.0 : 0.0); };
    double step[2] = {0.0, 0.0};
    for (const bool seams : {true, false}) {
        const Bake bake = bakeOf(geometry, mapSettings(1200), 0.0f, {true, seams});
        const BakedLight light(bake, radiance);
        size_t count = 0;
        double sum = 0.0;
        for (const SharedEdge& edge : edges) {
            if (edge.triangles[0] >= ofSphere || !light.isInMap(edge.triangles[0]) ||
                !light.isInMap(edge.triangles[1]))
                continue;
            const glm::dvec2 a = light.mapPlace(edge.triangles[0], edge.middles[0]);
            const glm::dvec2 b = light.mapPlace(edge.triangles[1], edge.middles[1]);
            if (glm::distance(a, b) < 0.1) continue; // of one chart
            const glm::vec3 normal =
                glm::normalize(glm::vec3(Triangle(geometry, edge.triangles[0]).at(edge.middles[0])) -
                               glm::vec3(2, 1.5f, 2.5f));
            const double first = light.atMap(a, normal), second = light.atMap(b, normal);
            sum += std::abs(first - second) / (first + second) * 2.0;
            ++count;
        }
        REQUIRE(count > 50);
        step[seams ? 0 : 1] = sum / double(count);
    }
    MESSAGE("mean step at seams " << step[0] << ", with edges repeated " << step[1]);
    CHECK(step[0] < 0.02);
    CHECK(step[0] < 0.6 * step[1]);
}

TEST_CASE("both sides of a curtain are in the map, and of a wall the one that is lit") {
    BakeGeometry geometry = closedBox();
    const uint32_t curtain = geometry.triangles();
    addQuad(geometry, {1, 0.5f, 2.5f}, {2, 0, 0}, {0, 2, 0}); // its front towards greater z
    const Bake bake = bakeOf(geometry, mapSettings(600));
    REQUIRE(bake.layout.mapBackRow > 0);
    CHECK(bake.layout.mapSize.y == 2 * bake.layout.mapBackRow);
    // The half of the room before the curtain's front is brighter.
    const BakedLight light(bake, [](glm::vec3 p, glm::vec3) { return p.z > 2.5f ? 2.0 : 1.0; });
    const glm::dvec2 front = light.mapPlace(curtain, {0.3, 0.3});
    const double before = light.atMap(front, {0, 0, 1});
    const double behind = light.atMap(front + glm::dvec2(0, bake.layout.mapBackRow), {0, 0, -1});
    CHECK(before == doctest::Approx(2.0).epsilon(0.02));
    CHECK(behind == doctest::Approx(1.0).epsilon(0.02));
    for (uint32_t wall = 0; wall < curtain; ++wall) {
        const glm::dvec2 place = light.mapPlace(wall, {0.3, 0.3}) + glm::dvec2(0, bake.layout.mapBackRow);
        CHECK(light.mapTexel(glm::ivec2(place)) == BakeLayout::noMapTexel);
    }
}

TEST_CASE("without a light map there is nothing of it") {
    const Bake bake = bakeOf(closedBox());
    CHECK(bake.layout.surfaceCaches == 0);
    CHECK(bake.section(BakeSection::mapTexels).empty());
    CHECK(bake.section(BakeSection::mapCorners).empty());
    BakeSettings settings = smallSettings();
    settings.lightMap = (1u << 20) + 1;
    const auto refused = validate(settings);
    REQUIRE(!refused);
    CHECK(refused.error().message == "settings.lightMap is 1048577; 0 to 1048576 was expected");
}
