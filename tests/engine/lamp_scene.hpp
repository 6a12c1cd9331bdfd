// SPDX-License-Identifier: MIT
// A spot light and a point light above a floor that glows, seen from above; a second floor between is masked away by its
// base colour's opacity.
#pragma once

#include "lab/images/image.hpp"
#include "lab/scenes/scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace rebound::engine {

// A square level plane around the height's axis.
inline lab::Mesh squarePlane(int material, float half, float height) {
    lab::Mesh m;
    m.material = material;
    m.positions = {
        {-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}};
    m.normals.assign(4, {0, 1, 0});
    m.indices = {0, 1, 2, 0, 2, 3};
    return m;
}

inline lab::Scene lampScene() {
    lab::Scene scene;
    lab::Material floor, hole;
    floor.baseColor = {0.5f, 0.5f, 0.5f, 1.0f};
    floor.emission = {0.25f, 0.0f, 0.0f};
    hole.alphaMasked = true;
    hole.baseColor.a = 0.2f;
    scene.materials = {floor, hole};
    scene.meshes = {squarePlane(0, 4.0f, 0.0f), squarePlane(1, 4.0f, 1.0f)};
    lab::Light light;
    light.type = lab::LightType::spot;
    light.position = {0, 3, 0};
    light.intensity = glm::vec3(9.0f);
    light.outerCone = light.innerCone = 0.5f;
    scene.lights = {light};
    light.type = lab::LightType::point;
    light.intensity = {0, 0, 18.0f};
    scene.lights.push_back(light);
    lab::CameraView view;
    view.position = {0, 6, 0};
    view.target = {0, 0, 0};
    view.up = {0, 0, -1};
    scene.cameras = {view};
    return scene;
}

// lit: direct light and emission of 65x65 pixels, against closed forms. radiance: what of it is sent to be gathered.
inline void checkLampLight(const lab::Image& lit, const lab::Image& radiance, const lab::Scene& scene) {
    const float pi = std::numbers::pi_v<float>;
    // Straight below: intensity over squared height; the mask above neither is seen nor casts a shadow.
    const float* middle = lit.at(32, 32);
    CHECK(middle[1] == doctest::Approx(0.5f * 1.0f / pi).epsilon(2e-3)); // a half
    CHECK(middle[0] == doctest::Approx(0.25f + 0.5f * 1.0f / pi).epsilon(2e-3));
    CHECK(middle[2] == doctest::Approx(0.5f * 3.0f / pi).epsilon(2e-3));
    // The floor's glow is sent only where it is no direct light; halves round each of the two stores by 2^-11.
    const float* sent = radiance.at(32, 32);
    const float glow = scene.emissiveMaterialsLight ? 0.25f : 0.0f;
    CHECK(sent[0] == doctest::Approx(middle[0] - glow).epsilon(2e-3));
    CHECK(sent[2] == middle[2]);
    // At 2 m to the side the spot's hard edge, at 3 tan(0.5) = 1.64 m, has been passed; the point light reaches on:
    // the pixel's centre lies 20 pixels of 6 m tan(0.5) / 32.5 off the middle.
    const float* side = lit.at(52, 32);
    const float distance = 20.0f * 6.0f * std::tan(0.5f) / 32.5f, squared = 9.0f + distance * distance;
    CHECK(distance > 3.0f * std::tan(0.5f));
    CHECK(side[1] == 0.0f);
    CHECK(side[2] == doctest::Approx(0.5f / pi * 18.0f * 3.0f / std::pow(squared, 1.5f)).epsilon(2e-3));
}

} // namespace rebound::engine
