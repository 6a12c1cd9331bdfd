// SPDX-License-Identifier: MIT
// Frames without waiting, resizes, timings, lights, shaders that do not compile.
#include "../engine/lamp_scene.hpp"
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
        for (Extent2D size :
             {Extent2D{64, 48}, Extent2D{97, 33}, Extent2D{31, 57}, Extent2D{1, 1}, Extent2D{96, 64}}) {
            require(renderer->resize(size, view));
            for (int i = 0; i < 3; ++i) require(renderer->render(view));
        }
        const auto fresh = rendererFor(scene, {96, 64}, view);
        require(fresh->render(view));
        const lab::Image composed = require(fresh->read(fresh->targets().composed, 3));
        CHECK(require(renderer->read(renderer->targets().composed, 3)).data == composed.data);
        CHECK(mean(composed) > 0.0);
        glFinish();
        CHECK(renderer->indirectLight().timings()->size() > 5);
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
    lab::Scene scene = lampScene();
    const lab::CameraView& view = scene.cameras.at(0);
    for (const bool isDirectLight : {true, false}) {
        scene.emissiveMaterialsLight = isDirectLight;
        const auto renderer = rendererFor(scene, {65, 65}, view);
        require(renderer->render(view));
        checkLampLight(require(renderer->read(renderer->targets().lit, 3)),
                       require(renderer->read(renderer->targets().radiance, 3)), scene);
    }
    checkSilence(context);
}

TEST_CASE("a directional light's shadow falls where it must, and nowhere else") {
    auto context = openContext();
    // A lid of 2 m x 2 m, 1 m above a floor, under light straight from above, seen from below the lid's height.
    lab::Scene scene;
    scene.materials.resize(1);
    scene.meshes = {squarePlane(0, 8.0f, 0.0f), squarePlane(0, 1.0f, 1.0f)};
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
    const auto made =
        makeProgram("broken", {{GL_COMPUTE_SHADER, "#version 430\nvoid main() { nonsense(); }\n"}});
    REQUIRE_FALSE(made);
    CHECK(made.error().message.find("broken") != std::string::npos);
    CHECK(made.error().message.find("nonsense") != std::string::npos);
}

} // namespace rebound::engine
