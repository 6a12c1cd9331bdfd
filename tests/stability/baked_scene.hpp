// SPDX-License-Identifier: MIT
// A scene that is baked once and lit anew each frame, as an engine runs it.
#pragma once

#include "lab/baking/bake_of_scene.hpp"
#include "lab/baking/surfel_light.hpp"
#include "lab/rays/frame.hpp"
#include "lab/runner/runner.hpp"
#include "lab/scenes/camera_matrices.hpp"
#include "rebound/techniques/illuminance_composition.hpp"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rebound::stability {

// The value; throws what went wrong, for doctest to print.
template <class T>
T take(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
}
inline void take(Result<> result) {
    if (!result) throw std::runtime_error(result.error().message);
}

template <class Number>
SharedBytes bytesOf(const std::vector<Number>& numbers) {
    const auto bytes = std::as_bytes(std::span(numbers));
    return std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
}

using Sections = std::array<std::vector<uint32_t>, bakeSectionCount>;

struct BakedSceneOptions {
    BakeSettings bake = {};
    bool bounces = true;
    int placesOfSurfel = 8; // that a surfel's light is averaged over
    Extent2D extent{61, 31};
};

class BakedScene {
public:
    using Options = BakedSceneOptions;

    // Watched from its first camera.
    BakedScene(lab::Scene described, const Options& chosen)
        : scene(std::make_shared<lab::Scene>(std::move(described))), options(chosen) {
        const auto rays = std::make_shared<const lab::EmbreeScene>(take(lab::EmbreeScene::build(*scene)));
        bake = take(lab::bakeOfScene(rays, options.bake));
        alter([](Sections&) {});
        backend = take(runner::createBackend({}));
        watch(scene->cameras.front());
    }

    // From now on, from there; nothing has been lit before.
    void watch(const lab::CameraView& camera) {
        frame = take(lab::renderFrame(*scene, camera, {.extent = options.extent}));
        settings.resolution = options.extent;
        settings.conventions.projection =
            camera.orthographic ? Projection::orthographic : Projection::perspective;
        settings.bake = bake.layout;
        settings.bounces = options.bounces;
        settings.compose = false;
        plan.reset();
    }

    // Changes what was baked, to switch a remedy off; nothing has been lit before.
    void alter(const std::function<void(Sections&)>& change) {
        Sections sections;
        for (size_t i = 0; i < sections.size(); ++i)
            sections[i].assign(bake.sections[i].begin(), bake.sections[i].end());
        change(sections);
        for (size_t i = 0; i < sections.size(); ++i) shared[i] = bytesOf(sections[i]);
        plan.reset();
    }

    // The next frame under these lights: irradiance over pi.
    lab::Image light(const std::vector<lab::Light>& lights) {
        scene->lights = lights;
        const lab::EmbreeScene rays = take(lab::EmbreeScene::build(*scene));
        IlluminanceCompositionFrame<lab::Image> inputs;
        inputs.camera = lab::cameraMatrices(frame.camera, settings.resolution);
        inputs.depth = frame.depth;
        inputs.normal = frame.normal;
        inputs.sections = shared;
        inputs.surfelLight =
            bytesOf(lab::directLightOnSurfels(bake, rays, {.places = options.placesOfSurfel}));
        const auto made = take(illuminanceCompositionInputs(settings, inputs));
        if (!plan)
            plan = take(backend->prepare(take(planIlluminanceComposition(settings)), made,
                                         {runner::Precision::single, false}));
        take(plan->runFrame(made));
        return take(plan->read("indirect"));
    }

    const lab::Scene& description() const { return *scene; }

private:
    std::shared_ptr<lab::Scene> scene;
    Options options;
    lab::Frame frame;
    Bake bake;
    std::array<SharedBytes, bakeSectionCount> shared;
    IlluminanceCompositionSettings settings;
    std::unique_ptr<runner::Backend> backend;
    std::unique_ptr<runner::PreparedPlan> plan;
};

} // namespace rebound::stability
