// SPDX-License-Identifier: MIT
// A scene that is baked once and lit anew each frame, as an engine runs it.
#pragma once

#include "../accuracy/take.hpp"

#include "lab/baking/bake_of_scene.hpp"
#include "lab/baking/surfel_light.hpp"
#include "lab/rays/frame.hpp"
#include "lab/runner/runner.hpp"
#include "lab/runner/shared_bytes.hpp"
#include "lab/scenes/camera_matrices.hpp"
#include "rebound/techniques/illuminance_composition.hpp"

#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace rebound::stability {

using accuracy::take;

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
        rays = std::make_shared<const lab::EmbreeScene>(take(lab::EmbreeScene::build(*scene)));
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
        for (size_t i = 0; i < sections.size(); ++i) shared[i] = runner::sharedBytes(sections[i]);
        plan.reset();
    }

    // The next frame under these lights: irradiance over pi.
    lab::Image light(const std::vector<lab::Light>& lights) {
        scene->lights = lights; // of which the rays know nothing
        IlluminanceCompositionFrame<lab::Image> inputs;
        inputs.camera = lab::cameraMatrices(frame.camera, settings.resolution);
        inputs.depth = frame.depth;
        inputs.normal = frame.normal;
        inputs.sections = shared;
        inputs.surfelLight =
            runner::sharedBytes(lab::directLightOnSurfels(bake, *rays, {.places = options.placesOfSurfel}));
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
    std::shared_ptr<const lab::EmbreeScene> rays;
    Options options;
    lab::Frame frame;
    Bake bake;
    std::array<SharedBytes, bakeSectionCount> shared;
    IlluminanceCompositionSettings settings;
    std::unique_ptr<runner::Backend> backend;
    std::unique_ptr<runner::PreparedPlan> plan;
};

} // namespace rebound::stability
