// SPDX-License-Identifier: MIT
// Frames without waiting, resizes, timings, lights, shaders that do not compile.
#include "engine_run.hpp"

#include <cmath>
#include <numbers>

namespace rebound::engine {

TEST_CASE("resizes between frames: no message, and the picture of a renderer that was never resized") {
    auto context = openContext();
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    {
        const auto renderer = rendererFor(scene, {64, 48}, view);
        for (Extent2D size : {Extent2D{64, 48}, Extent2D{97, 33}, Extent2D{31, 57}, Extent2D{1, 1}, Extent2D{96, 64}}) {
            require(renderer->resize(size, view));
            for (int i = 0; i < 3; ++i) require(renderer->render(view));
        }
        const auto fresh = rendererFor(scene, {96, 64}, view);
        require(fresh->render(view));
        const lab::Image composed = require(fresh->read(fresh->targets().composed, 3));
        CHECK(require(renderer->read(renderer->targets().composed, 3)).data == composed.data);
        CHECK(mean(composed) > 0.0);
        glFinish();
        CHECK(renderer->indirectLight().timings().size() > 5);
    }
    checkSilence(context);
}

TEST_CASE("what cannot be resized stays as it was") {
    auto context = openContext();
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    {
        const auto renderer = rendererFor(scene, {64, 48}, view);
        CHECK_FALSE(renderer->resize({0, 48}, view));
        context.takeMessages(); // which it was right to send
        CHECK(renderer->targets().extent == Extent2D{64, 48});
        require(renderer->render(view));
        CHECK(mean(require(renderer->read(renderer->targets().composed, 3))) > 0.0);
    }
    checkSilence(context);
}

TEST_CASE("a spot light, a point light, emission and an alpha mask, against closed forms") {
    auto context = openContext();
    // A floor of 8 m x 8 m seen from above; a second one above it is masked away by its base colour's opacity.
    lab::Scene scene;
    lab::Material floor, hole;
    floor.baseColor = {0.5f, 0.5f, 0.5f, 1.0f};
    floor.emission = {0.25f, 0.0f, 0.0f};
    hole.alphaMasked = true;
    hole.baseColor.a = 0.2f;
    scene.materials = {floor, hole};
    const auto plane = [](int material, float height) {
        lab::Mesh m;
        m.material = material;
        m.positions = {{-4, height, -4}, {4, height, -4}, {4, height, 4}, {-4, height, 4}};
        m.normals.assign(4, {0, 1, 0});
        m.indices = {0, 1, 2, 0, 2, 3};
        return m;
    };
    scene.meshes = {plane(0, 0.0f), plane(1, 1.0f)};
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
    view.up = {0, 0, -1};
    view.target = {0, 0, 0};
    {
        const auto renderer = rendererFor(scene, {65, 65}, view);
        require(renderer->render(view));
        const lab::Image lit = require(renderer->read(renderer->targets().lit, 3));
        const float pi = std::numbers::pi_v<float>;
        // Straight below: intensity over squared height; the mask above neither is seen nor casts a shadow.
        const float* middle = lit.at(32, 32);
        CHECK(middle[1] == doctest::Approx(0.5f * 1.0f / pi).epsilon(2e-3)); // a half
        CHECK(middle[0] == doctest::Approx(0.25f + 0.5f * 1.0f / pi).epsilon(2e-3));
        CHECK(middle[2] == doctest::Approx(0.5f * 3.0f / pi).epsilon(2e-3));
        // At 2 m to the side the spot's hard edge, at 3 tan(0.5) = 1.64 m, has been passed; the point light reaches on:
        // the pixel's centre lies 20 pixels of 6 m tan(0.5) / 32.5 off the middle.
        const float* side = lit.at(52, 32);
        const float distance = 20.0f * 6.0f * std::tan(0.5f) / 32.5f, squared = 9.0f + distance * distance;
        CHECK(distance > 3.0f * std::tan(0.5f));
        CHECK(side[1] == 0.0f);
        CHECK(side[2] == doctest::Approx(0.5f / pi * 18.0f * 3.0f / std::pow(squared, 1.5f)).epsilon(2e-3));
    }
    checkSilence(context);
}

TEST_CASE("a directional light's shadow falls where it must, and nowhere else") {
    auto context = openContext();
    // A lid of 2 m x 2 m, 1 m above a floor, under light straight from above, seen from below the lid's height.
    lab::Scene scene;
    scene.materials.resize(1);
    const auto plane = [](float half, float height) {
        lab::Mesh m;
        m.positions = {{-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}};
        m.normals.assign(4, {0, 1, 0});
        m.indices = {0, 1, 2, 0, 2, 3};
        return m;
    };
    scene.meshes = {plane(8.0f, 0.0f), plane(1.0f, 1.0f)};
    lab::Light sun;
    sun.direction = {0, -1, 0};
    scene.lights = {sun};
    lab::CameraView view;
    view.orthographic = true;
    view.orthographicHeight = 6.0f;
    view.position = {0, 0.5f, 0}; // below the lid
    view.target = {0, 0, 0};
    view.up = {0, 0, -1};
    view.nearPlane = 0.1f;
    view.farPlane = 10.0f;
    {
        const auto renderer = rendererFor(scene, {60, 60}, view);
        require(renderer->render(view));
        const lab::Image lit = require(renderer->read(renderer->targets().lit, 1));
        for (int x = 0; x < 60; ++x) { // 0.1 m each; the shadow is 10 pixels to either side of the middle
            INFO("column ", x);
            const bool shadowed = x > 20 && x < 39, rim = x == 19 || x == 20 || x == 39 || x == 40;
            const float expected = shadowed ? 0.0f : 1.0f / std::numbers::pi_v<float>;
            if (!rim) CHECK(*lit.at(x, 30) == doctest::Approx(expected).epsilon(2e-3));
        }
    }
    checkSilence(context);
}

TEST_CASE("a shader that the driver refuses is named, with the driver's words") {
    const auto context = openContext();
    const auto made = makeProgram("broken", {{GL_COMPUTE_SHADER, "#version 430\nvoid main() { nonsense(); }\n"}});
    REQUIRE_FALSE(made);
    CHECK(made.error().message.find("broken") != std::string::npos);
    CHECK(made.error().message.find("nonsense") != std::string::npos);
}

} // namespace rebound::engine
