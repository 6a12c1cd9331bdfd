// SPDX-License-Identifier: MIT
#include "link_cut.hpp"
#include "surfel_lookup.hpp"

#include "rebound/bake/hierarchy.hpp"
#include "rebound/bake/surfels.hpp"
#include "rebound/embree/ray_caster.hpp"

#include "baked_light.hpp"
#include "rooms.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <set>

using namespace rebound;
using namespace rebound::detail;

namespace {

constexpr double sphere = 4.0 * std::numbers::pi;

// A scene up to its tree, whose caches stand where a test wants them.
struct Senders {
    BakeGeometry geometry;
    EmbreeRayCaster rays;
    BakeSettings settings;
    std::vector<Surfel> surfels;
    SurfelTree tree;

    Senders(BakeGeometry g, const BakeSettings& s)
        : geometry(std::move(g)), rays(std::move(*EmbreeRayCaster::build(geometry))), settings(s),
          surfels(*placeSurfels(geometry, rays, settings)),
          tree(*buildSurfelTree(surfels, settings.hierarchy, 2)) {}

    // before: places that are looked at first. normal: of the surface that the place lies on.
    std::vector<SeenSender> cut(glm::vec3 place, uint32_t index = 0,
                                std::initializer_list<glm::vec3> before = {},
                                glm::vec3 normal = glm::vec3(0.0f)) const {
        const Surroundings around(geometry, rays);
        const SurfelLookup lookup(std::span(tree.nodes).first(surfels.size()));
        LinkCutter cutter(around, tree, lookup, settings);
        for (const glm::vec3 other : before) cutter.cut(other, glm::vec3(0.0f), 1);
        return cutter.cut(place, normal, index);
    }
};

double solidAngle(const std::vector<SeenSender>& senders) {
    double sum = 0.0;
    for (const SeenSender& sender : senders) sum += double(sender.coefficients[0]) * std::sqrt(sphere);
    return sum;
}

} // namespace

TEST_CASE("a cache on a surface sees the half space before it, by all its rays") {
    const Senders box(closedBox(), smallSettings());
    const glm::vec3 normal(0, 1, 0);
    double along = 0.0;
    for (const SeenSender& sender : box.cut({1.3f, 0.003f, 2.1f}, 0, {}, normal)) {
        along += double(sender.coefficients[1]); // of y: sqrt(3 / (4 pi)) times the mean cosine
        CHECK(sender.coefficients[1] >= 0.0f);
    }
    CHECK(solidAngle(box.cut({1.3f, 0.003f, 2.1f}, 0, {}, normal)) ==
          doctest::Approx(0.5 * sphere).epsilon(1e-5));
    // The cosine over half a sphere is pi; 256 directions of an even set, mirrored.
    CHECK(along == doctest::Approx(std::sqrt(3.0 / sphere) * std::numbers::pi).epsilon(0.01));
}

TEST_CASE("a cache's links cover the solid angle that surfaces cover") {
    const Senders box(closedBox(), smallSettings());
    for (const glm::vec3 place :
         {glm::vec3(2, 1.5f, 2.5f), {0.01f, 1.0f, 1.0f}, {0.02f, 0.02f, 0.02f}, {3.9f, 2.0f, 0.3f}})
        // Every ray meets a surfel's surroundings, and counts once.
        CHECK(solidAngle(box.cut(place)) == doctest::Approx(sphere).epsilon(1e-5));

    BakeGeometry ground;
    addQuad(ground, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
    addQuad(ground, {-50, 30, -50}, {100, 0, 0}, {0, 0, 100}); // a ceiling, lit by the ground
    const Senders hall(std::move(ground), smallSettings());
    for (const float height : {0.1f, 1.0f, 15.0f}) {
        // Between two squares, off their middle: what they cover in closed form.
        const auto covered = [](double x, double z, double d) { // of a rectangle's corner at a distance
            return std::atan(x * z / (d * std::sqrt(x * x + z * z + d * d)));
        };
        const auto square = [&](double d) {
            return covered(57, 47, d) + covered(43, 47, d) + covered(57, 53, d) + covered(43, 53, d);
        };
        const double expected = square(height) + square(30.0 - height);
        // Even points on a sphere, of 256: an edge leaves about the square root of those that it crosses uncertain,
        // some 30 of them.
        CHECK(solidAngle(hall.cut({7, height, 3})) == doctest::Approx(expected).epsilon(6.0 / 256.0));
    }
}

TEST_CASE("no surfel is below two links, and those that are below none are not seen") {
    BakeGeometry geometry = closedBox();
    addBox(geometry, {1.5f, 0, 2}, {2.5f, 2, 3});
    BakeSettings settings = smallSettings();
    for (const uint32_t links : {1u, 7u, 32u, 200u}) {
        settings.links = links;
        settings.raysPerLink = std::min(4096 / links, 1024u);
        const Senders scene(geometry, settings);
        const std::vector<SeenSender> senders = scene.cut({0.5f, 1, 0.5f});
        CHECK(senders.size() == links);
        std::set<uint32_t> below;
        for (const SeenSender& sender : senders) {
            const SurfelNode& node = scene.tree.nodes[sender.node];
            for (uint32_t leaf = node.firstLeaf; leaf < node.firstLeaf + node.leaves; ++leaf)
                REQUIRE(below.insert(leaf).second);
        }
        if (links == 1) continue;
        size_t missing = 0, visible = 0;
        for (uint32_t leaf = 0; leaf < scene.surfels.size(); ++leaf) {
            const SurfelNode& node = scene.tree.nodes[leaf];
            const glm::vec3 towards = node.position + node.normal * 1e-3f - glm::vec3(0.5f, 1, 0.5f);
            const float distance = glm::length(towards);
            if (glm::dot(towards, node.normal) > -0.2f * distance) continue; // grazing ones are small
            const BakeRay ray{glm::vec3(0.5f, 1, 0.5f), 0.0f, towards / distance, distance};
            uint8_t hidden = 0;
            scene.rays.occluded({&ray, 1}, {&hidden, 1});
            if (hidden) continue;
            ++visible;
            missing += below.count(leaf) == 0;
        }
        CHECK(visible > 500);
        // Smaller than what a ray stands for, they are missed by all of them now and then.
        CHECK(double(missing) < 0.1 * double(visible));
    }
}

TEST_CASE("in a closed box of constant radiance a cache sees the same radiance in every direction") {
    BakeSettings settings = smallSettings();
    for (const uint32_t bands : {2u, 3u, 4u}) {
        settings.bands = bands;
        const Bake bake = bakeOf(closedBox(), settings);
        const BakedLight light(bake, [](glm::vec3, glm::vec3) { return 1.0; });
        for (size_t cache = 0; cache < bake.layout.caches; ++cache) {
            const BakedLight::Coefficients c = light.atCache(cache);
            CHECK(c[0] == doctest::Approx(std::sqrt(sphere)).epsilon(1e-5));
            // 256 even directions integrate harmonics to 0.1 %; of 32 shapes each is rounded by up to 1/254 of
            // sqrt(2 l + 1), in whichever direction: together some 0.5/127/sqrt(3)/sqrt(32) of them.
            for (size_t i = 1; i < bake.layout.coefficients(); ++i)
                CHECK(std::abs(c[i]) < 0.01 * std::sqrt(sphere));
        }
    }
}

TEST_CASE("light of one room does not arrive in the next") {
    BakeSettings settings = smallSettings();
    settings.links = 128;
    // Surfels are 0.27 m apart: of thinner walls they may stand for both sides.
    for (const float wall : {0.2f, 0.6f}) {
        const Bake bake = bakeOf(twoRooms(wall), settings);
        const BakedLight light(bake,
                               [&](glm::vec3 p, glm::vec3) { return p.x > 3.0f + 0.5f * wall ? 1.0 : 0.0; });
        size_t first = 0;
        for (size_t cache = 0; cache < bake.layout.caches; ++cache) {
            const bool isInFirst = light.place(cache).x < 3.0f + 0.5f * wall;
            first += isInFirst;
            const double seen = light.atCache(cache)[0] / std::sqrt(sphere);
            if (isInFirst) CHECK(seen < 1e-3);
            else CHECK(seen == doctest::Approx(1.0).epsilon(1e-3));
        }
        CHECK(first > bake.layout.caches / 4);
    }
}

TEST_CASE("a small lamp is seen from afar as large as it is") {
    BakeGeometry geometry = closedBox();
    const uint32_t first = geometry.triangles();
    addQuad(geometry, {1.98f, 2.5f, 2.48f}, {0.05f, 0, 0}, {0, 0, 0.05f}); // 5 cm, faces down
    addQuad(geometry, {1.0f, 1.5f, 2.0f}, {0.5f, 0, 0}, {0, 0, 1}); // shades a part of the floor, from below
    geometry.surface = [first](uint32_t triangle, glm::vec2) {
        BakeSurface surface;
        surface.emission = glm::vec3(triangle == first || triangle == first + 1 ? 1.0f : 0.0f);
        return surface;
    };
    const Senders scene(geometry, smallSettings());
    const double area = 0.05 * 0.05;
    for (const glm::vec3 place :
         {glm::vec3(2, 0.3f, 2.5f), {3.5f, 0.5f, 4.5f}, {0.5f, 1.0f, 0.5f}, {1.2f, 1.2f, 2.4f}}) {
        const glm::dvec3 towards = glm::dvec3(2.005, 2.5, 2.505) - glm::dvec3(place);
        const double distance = glm::length(towards);
        const bool isShaded = place.x == 1.2f;
        const double expected = isShaded ? 0.0 : area * towards.y / (distance * distance * distance);
        REQUIRE(expected < 0.1 * sphere / 256.0); // far from what rays in all directions could tell
        double seen = 0.0;
        for (const SeenSender& sender : scene.cut(place)) {
            double emitting = 0.0; // area below it
            const SurfelNode& node = scene.tree.nodes[sender.node];
            for (uint32_t leaf = node.firstLeaf; leaf < node.firstLeaf + node.leaves; ++leaf) {
                const Surfel& surfel = scene.surfels[scene.tree.order[leaf]];
                if (surfel.emission.x > 0.0f && surfel.normal.y < 0.0f) emitting += double(surfel.area);
            }
            seen += double(sender.coefficients[0]) * std::sqrt(sphere) * emitting / double(node.area);
        }
        // Where it is seen, its cluster holds next to nothing else.
        CHECK(seen == doctest::Approx(expected).epsilon(0.1));
    }
}

TEST_CASE("what a cache sees does not depend on which one was looked at before") {
    BakeGeometry geometry = closedBox();
    const uint32_t first = geometry.triangles();
    addQuad(geometry, {1.98f, 2.5f, 2.48f}, {0.05f, 0, 0}, {0, 0, 0.05f}); // a lamp, met by rays of its own
    geometry.surface = [first](uint32_t triangle, glm::vec2) {
        BakeSurface surface;
        surface.emission = glm::vec3(triangle >= first ? 1.0f : 0.0f);
        return surface;
    };
    const Senders scene(geometry, smallSettings());
    const glm::vec3 near(2.0f, 2.3f, 2.5f), far(0.3f, 0.3f, 4.5f);
    const std::vector<SeenSender> alone = scene.cut(far);
    const std::vector<SeenSender> after = scene.cut(far, 0, {near});
    REQUIRE(after.size() == alone.size());
    for (size_t i = 0; i < alone.size(); ++i) {
        CHECK(after[i].node == alone[i].node);
        CHECK(after[i].coefficients == alone[i].coefficients);
    }
}

TEST_CASE("light that surfels differ in arrives as a sum over many more rays has it") {
    BakeSettings settings = smallSettings();
    settings.links = 128;
    const Senders box(closedBox(), settings);
    BakeSettings finest = settings;
    finest.links = 4096; // more than surfels: nothing is taken together
    finest.raysPerLink = 16;
    const Surroundings around(box.geometry, box.rays);
    const SurfelLookup lookup(std::span(box.tree.nodes).first(box.surfels.size()));
    LinkCutter every(around, box.tree, lookup, finest);
    std::vector<double> flux(box.tree.nodes.size());
    for (size_t i = 0; i < flux.size(); ++i) {
        const SurfelNode& node = box.tree.nodes[i];
        flux[i] = node.isLeaf()
                      ? double(node.area) * (node.position.y < 0.01f && node.position.x < 1.0f ? 1.0 : 0.1)
                      : flux[node.children[0]] + flux[node.children[1]];
    }
    const auto irradiance = [&](const std::vector<SeenSender>& senders, glm::vec3 normal) {
        BakedLight::Coefficients sum{};
        for (const SeenSender& sender : senders)
            for (size_t i = 0; i < 9; ++i)
                sum[i] += double(sender.coefficients[i]) * flux[sender.node] /
                          double(box.tree.nodes[sender.node].area);
        return BakedLight::irradiance(sum, normal);
    };
    double error = 0.0, total = 0.0;
    for (uint32_t k = 0; k < 20; ++k) {
        const glm::vec3 place(0.3f + 0.17f * float(k), 0.4f + 0.1f * float(k), 0.5f + 0.2f * float(k));
        for (const glm::vec3 normal : {glm::vec3(0, -1, 0), {-1, 0, 0}, {0, 0, 1}}) {
            const double expected = irradiance(every.cut(place, glm::vec3(0.0f), 0), normal);
            error += std::pow(irradiance(box.cut(place, k), normal) - expected, 2.0);
            total += expected * expected;
        }
    }
    // 1024 rays of an even set: an edge of the lit strip crosses some 30 of them.
    CHECK(std::sqrt(error / total) < 0.04);
}
