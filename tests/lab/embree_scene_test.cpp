// SPDX-License-Identifier: MIT
#include "lab/rays/embree_scene.hpp"

#include "frame_test_scene.hpp"
#include "lab/light/emissive_surfaces.hpp"
#include "lab/light/low_discrepancy.hpp"

#include <map>
#include <set>
#include <utility>

using namespace rebound;
using namespace rebound::lab;

namespace {

EmbreeScene built(const Scene& scene) {
    auto result = EmbreeScene::build(scene);
    REQUIRE_MESSAGE(result, (result ? "" : result.error().message));
    return *std::move(result);
}

} // namespace

TEST_CASE("a ray meets the nearest surface within its range") {
    Scene scene = floorScene(10.0f, {0.1f, 0.2f, 0.3f});
    addQuad(scene, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, addMaterial(scene, {0.9f, 0, 0}, {1, 2, 3}));
    const EmbreeScene embree = built(scene);
    Ray ray{{0.25f, 5, 0.5f}, {0, -2, 0}}; // t counts steps of 2 m
    auto hit = embree.intersect(ray);
    REQUIRE(hit);
    CHECK(hit->distance == 2.0f);
    CHECK(hit->point.position == glm::vec3(0.25f, 1, 0.5f));
    CHECK(hit->point.location.mesh == 1);
    CHECK(hit->point.emission == glm::vec3(1, 2, 3));
    CHECK(glm::length(embree.positionAt(hit->point.location) - hit->point.position) < 1e-6f);
    ray.minimum = 2.1f;
    hit = embree.intersect(ray);
    REQUIRE(hit);
    CHECK(hit->point.location.mesh == 0);
    CHECK(hit->point.albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(hit->point.geometricNormal == glm::vec3(0, 1, 0));
    CHECK(embree.occluded(ray));
    ray.maximum = 2.4f;
    CHECK_FALSE(embree.intersect(ray));
    CHECK_FALSE(embree.locate(ray));
    CHECK_FALSE(embree.occluded(ray));
}

TEST_CASE("a surface seen from behind turns its normals") {
    const Scene scene = floorScene();
    const EmbreeScene embree = built(scene);
    const auto hit = embree.intersect({{0.3f, -1, 0.2f}, {0, 1, 0}});
    REQUIRE(hit);
    CHECK(hit->point.geometricNormal == glm::vec3(0, -1, 0));
    CHECK(hit->point.shadingNormal == glm::vec3(0, -1, 0));
    CHECK(embree.visible(hit->point, glm::vec3(3, -4, 5)));
    CHECK_FALSE(embree.visible(hit->point, glm::vec3(3, 4, 5)));
    CHECK(embree.open(hit->point, glm::vec3(0.1f, -1, 0)));
}

TEST_CASE("an invalid scene is an error, and a moved one still works") {
    CHECK_FALSE(EmbreeScene::build(Scene()));
    const Scene scene = floorScene();
    EmbreeScene first = built(scene);
    const EmbreeScene second = std::move(first);
    CHECK(&second.scene() == &scene);
    CHECK(second.occluded({{0, 1, 0}, {0, -1, 0}}));
}

TEST_CASE("emissive triangles are chosen in proportion to area times emission") {
    Scene scene = floorScene();
    const int dim = addMaterial(scene, glm::vec3(0.0f), glm::vec3(1.0f));
    const int bright = addMaterial(scene, glm::vec3(0.0f), glm::vec3(3.0f));
    addQuad(scene, {0, 1, 0}, {2, 0, 0}, {0, 0, 0.5f}, dim);    // 4 m^2: power 4
    addQuad(scene, {0, 2, 0}, {0.5f, 0, 0}, {0, 0, 1}, bright); // 2 m^2: power 6
    const EmbreeScene embree = built(scene);
    const EmissiveSurfaces surfaces(embree);
    std::map<std::pair<uint32_t, uint32_t>, int> counts;
    constexpr int samples = 10000;
    for (uint32_t i = 0; i < samples; ++i) {
        const SurfaceLocation at = surfaces.sample(sobolPoint(i, 5));
        ++counts[{at.mesh, at.triangle}];
        REQUIRE(at.u >= 0.0f);
        REQUIRE(at.v >= 0.0f);
        REQUIRE(at.u + at.v <= 1.00001f);
    }
    // Stratified, so that counts are off by a few at most.
    for (const uint32_t triangle : {0u, 1u}) {
        CHECK(counts[{1u, triangle}] == doctest::Approx(2000).scale(0.0).epsilon(0.01));
        CHECK(counts[{2u, triangle}] == doctest::Approx(3000).scale(0.0).epsilon(0.01));
        CHECK(surfaces.density({1, triangle}) == doctest::Approx(0.2 / 2.0));
        CHECK(surfaces.density({2, triangle}) == doctest::Approx(0.3 / 1.0));
        CHECK(surfaces.density({0, triangle}) == 0.0f);
    }
    scene.emissiveMaterialsLight = false;
    CHECK(EmissiveSurfaces(embree).empty());
}

TEST_CASE("low-discrepancy points hit every stratum once, whatever the seed") {
    for (const uint32_t seed : {0u, 1u, 12345u, 0xffffffffu})
        for (const int columns : {1, 2, 8, 64}) { // elementary intervals of 64 points
            const int rows = 64 / columns;
            std::set<int> strata;
            for (uint32_t i = 0; i < 64; ++i) {
                const glm::vec2 point = sobolPoint(i, seed);
                REQUIRE((point.x >= 0.0f && point.x < 1.0f && point.y >= 0.0f && point.y < 1.0f));
                strata.insert(int(point.x * float(columns)) + columns * int(point.y * float(rows)));
            }
            CHECK(strata.size() == 64);
        }
}
