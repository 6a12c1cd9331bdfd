// SPDX-License-Identifier: MIT
#include "lab/baking/surfel_light.hpp"

#include "../lab/frame_test_scene.hpp"
#include "made_bake.hpp"

#include <numbers>

namespace rebound::lab {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Light sun(glm::vec3 direction, float irradiance) {
    Light light;
    light.direction = glm::normalize(direction);
    light.intensity = glm::vec3(irradiance);
    return light;
}

// 4 x 4 m, facing up.
Scene floorAlone() {
    Scene scene;
    addMaterial(scene, glm::vec3(0.5f));
    addQuad(scene, glm::vec3(0.0f), glm::vec3(2, 0, 0), glm::vec3(0, 0, -2));
    return scene;
}

EmbreeScene raysOf(const Scene& scene) {
    auto rays = EmbreeScene::build(scene);
    REQUIRE(rays);
    return *std::move(rays);
}

} // namespace

TEST_CASE("a surfel receives the irradiance of its side") {
    Scene scene = floorAlone();
    scene.lights.push_back(sun({1, -1, 0}, 10.0f));
    const EmbreeScene rays = raysOf(scene);
    const Bake bake = surfelsOnly({{{0, 0, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.5f), {}},
                                   {{0, 0, 0}, {0, -1, 0}, 1.0f, glm::vec3(0.5f), {}}});
    const std::vector<float> light = directLightOnSurfels(bake, rays, {});
    const uint32_t stride = BakeLayout::stride(2);
    REQUIRE(light.size() == 3 * stride);
    for (uint32_t channel = 0; channel < 3; ++channel) {
        CHECK(light[channel * stride] == doctest::Approx(10.0 * std::sqrt(0.5) / double(pi)).epsilon(1e-5));
        CHECK(light[channel * stride + 1] == 0.0f);
    }
}

TEST_CASE("a surfel at a shadow's edge receives the lit share of its disc") {
    Scene scene = floorAlone();
    scene.lights.push_back(sun({0, -1, 0}, 1.0f));
    // Hides what lies at x < 0.
    addQuad(scene, {-2, 1, 0}, {2, 0, 0}, {0, 0, -4});
    const EmbreeScene rays = raysOf(scene);
    const Bake bake = surfelsOnly({{{0, 0, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.5f), {}}});
    SurfelLightOptions options;
    options.places = 256;
    const std::vector<float> light = directLightOnSurfels(bake, rays, options);
    // 256 places of a sequence of low discrepancy count a half disc to about 1 / 256.
    CHECK(light[0] * pi == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("light on surfels does not depend on the number of threads") {
    Scene scene = floorAlone();
    Light lamp;
    lamp.type = LightType::area;
    lamp.position = {0, 2, 0};
    scene.lights.push_back(lamp);
    const EmbreeScene rays = raysOf(scene);
    std::vector<Surfel> surfels;
    for (int i = 0; i < 600; ++i)
        surfels.push_back({{float(i % 25) * 0.1f - 1.0f, 0, float(i / 25) * 0.1f - 1.0f},
                           {0, 1, 0},
                           0.01f,
                           glm::vec3(0.5f),
                           {}});
    const Bake bake = surfelsOnly(surfels);
    SurfelLightOptions one, five;
    one.threads = 1;
    five.threads = 5;
    const auto first = directLightOnSurfels(bake, rays, one);
    CHECK(first == directLightOnSurfels(bake, rays, five));
    CHECK(first[0] > 0.0f);
}

} // namespace rebound::lab
