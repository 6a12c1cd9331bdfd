// SPDX-License-Identifier: MIT
#include "plain_ray_caster.hpp"
#include "shapes.hpp"

#include "rebound/embree/ray_caster.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <random>
#include <vector>

using namespace rebound;

namespace {

// A room with a sphere in it, and a screen of which every second stripe is a hole.
BakeGeometry room() {
    BakeGeometry geometry;
    addQuad(geometry, {-1.9f, -1.9f, 1.0f}, {3.8f, 0, 0}, {0, 3.8f, 0});
    addBox(geometry, {-2, -2, -2}, {2, 2, 2}, true);
    addSphere(geometry, {0.3f, -0.2f, -0.5f}, 0.8f, 8);
    geometry.surface = [](uint32_t triangle, glm::vec2 place) {
        BakeSurface surface;
        surface.hole = triangle < 2 && int(std::floor((place.x + place.y) * 10.0f)) % 2 == 0;
        return surface;
    };
    return geometry;
}

std::vector<BakeRay> raysInside(uint32_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<BakeRay> rays;
    while (rays.size() < count) {
        BakeRay ray;
        ray.origin = 1.8f * glm::vec3(uniform(random), uniform(random), uniform(random));
        const glm::vec3 direction(uniform(random), uniform(random), uniform(random));
        if (glm::length(direction) < 0.1f) continue;
        ray.direction = glm::normalize(direction);
        if (rays.size() % 3 == 0) ray.maximum = 1.0f + uniform(random);
        if (rays.size() % 3 == 1) ray.minimum = 1.0f + uniform(random);
        rays.push_back(ray);
    }
    return rays;
}

} // namespace

TEST_CASE("Embree meets what a loop over all triangles meets, through holes too") {
    BakeGeometry geometry = room();
    const std::vector<BakeRay> rays = raysInside(4000);
    for (const bool holesAreAnnounced : {false, true}) {
        if (holesAreAnnounced) geometry.mayHaveHoles = [](uint32_t triangle) { return triangle < 2; };
        const auto caster = EmbreeRayCaster::build(geometry);
        REQUIRE(caster);
        std::vector<BakeHit> hits(rays.size()), expected(rays.size());
        std::vector<uint8_t> occluded(rays.size());
        caster->intersect(rays, hits);
        caster->occluded(rays, occluded);
        PlainRayCaster(geometry).intersect(rays, expected);
        int throughScreen = 0, differing = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const bool same = hits[i].triangle == expected[i].triangle;
            differing += !same;
            CHECK((occluded[i] != 0) == (hits[i].triangle != noTriangle));
            if (!same || hits[i].triangle == noTriangle) continue;
            // A few roundings of a scene of size 4.
            CHECK(hits[i].distance == doctest::Approx(expected[i].distance).epsilon(1e-4));
            CHECK(glm::length(hits[i].barycentrics - expected[i].barycentrics) < 1e-4f);
            const glm::vec3 end = rays[i].origin + hits[i].distance * rays[i].direction;
            throughScreen += (rays[i].origin.z - 1.0f) * (end.z - 1.0f) < 0.0f;
        }
        CHECK(throughScreen > 50);
        CHECK(differing <= 4); // rays that leave by an edge, or by that of a stripe, may round to either side
    }
}

TEST_CASE("Embree outlives the geometry that it was built from") {
    auto geometry = std::make_unique<BakeGeometry>(room());
    const auto caster = EmbreeRayCaster::build(*geometry);
    REQUIRE(caster);
    geometry.reset();
    std::array<BakeHit, 1> hit;
    caster->intersect(std::array{BakeRay{{0.3f, -0.2f, 1.9f}, 0.0f, {0, 0, -1}}}, hit);
    CHECK(hit[0].triangle != noTriangle);
}

TEST_CASE("Embree refuses what is no geometry") {
    BakeGeometry geometry = room();
    geometry.positions[5] = {2.0f, std::numeric_limits<float>::quiet_NaN(), -1.5f};
    const auto caster = EmbreeRayCaster::build(geometry);
    REQUIRE(!caster);
    CHECK(caster.error().message ==
          "geometry.positions[5] is (2, nan, -1.5); finite coordinates were expected");
}
