// SPDX-License-Identifier: MIT
// Scenes in which it is known where light comes from.
#pragma once

#include "../lab/frame_test_scene.hpp"
#include "lab/explain/error_causes.hpp"

namespace rebound::explain {

// A floor from x = 0 to 2 and a wall at x = 0, two metres long and high; a sun that shines along the wall
// lights only the floor.
inline lab::Scene cornerScene() {
    lab::Scene scene;
    scene.name = "corner";
    lab::addMaterial(scene, glm::vec3(0.5f));
    lab::addQuad(scene, {1, 0, 0}, {0, 0, 1}, {1, 0, 0});
    lab::addQuad(scene, {0, 1, 0}, {0, 1, 0}, {0, 0, 1});
    lab::Light sun;
    sun.direction = {0, -1, 0};
    sun.intensity = glm::vec3(3.0f);
    scene.lights = {sun};
    return scene;
}

// Sees all of the corner.
inline lab::CameraView cornerCamera() {
    lab::CameraView camera;
    camera.name = "corner";
    camera.position = {5, 4, 0};
    camera.target = {0.7f, 0.7f, 0};
    camera.verticalFieldOfView = 0.8f;
    return camera;
}

inline ExplainOptions optionsOf(Extent2D extent = {64, 48}, int samples = 64, int bounces = 3) {
    ExplainOptions options;
    options.draft["preset"] = "half-64";
    options.extent = extent;
    options.samples = samples;
    options.bounces = bounces;
    return options;
}

inline Explanation explained(const lab::Scene& scene, const lab::CameraView& camera,
                             const ExplainOptions& options) {
    auto explanation = explainError(scene, camera, options);
    REQUIRE_MESSAGE(explanation, (explanation ? "" : explanation.error().message));
    return *std::move(explanation);
}

inline const Cause& causeNamed(const Explanation& explanation, const std::string& name) {
    for (const Cause& cause : explanation.causes)
        if (cause.name == name) return cause;
    FAIL("no cause is named " << name);
    return explanation.whole;
}

} // namespace rebound::explain
