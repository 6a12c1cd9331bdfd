// SPDX-License-Identifier: MIT
// An engine's frames with light from a bake against the CPU device's: a hall, a ball that the bake does not know, a light
// that moves and one that switches.
#pragma once

#include "agreement.hpp"

#include "lab/baking/bake_of_scene.hpp"
#include "lab/engine/moment.hpp"
#include "lab/runner/shared_bytes.hpp"
#include "rebound/techniques/illuminance_composition.hpp"

#include <memory>
#include <vector>

namespace rebound::engine {

inline lab::Scene hall() {
    lab::Scene scene = lab::makeCornellBox();
    lab::Light spot, lamp;
    spot.type = lab::LightType::spot;
    spot.position = {0.5f, 5.3f, 0.0f};
    spot.direction = glm::normalize(glm::vec3(-0.5f, -1.0f, -0.2f));
    spot.intensity = glm::vec3(60.0f);
    spot.innerCone = 0.3f;
    spot.outerCone = 0.6f;
    lamp.type = lab::LightType::point;
    lamp.position = {2.0f, 2.5f, 1.0f};
    lamp.intensity = {4.0f, 8.0f, 12.0f};
    scene.lights = {spot, lamp};
    return scene;
}

inline Bake bakeOfHall(const lab::Scene& scene) {
    auto rays = require(lab::EmbreeScene::build(scene));
    BakeSettings settings;
    settings.surfels = 1500;
    settings.caches = 600;
    settings.links = 32;
    auto shared = std::make_shared<const lab::EmbreeScene>(std::move(rays));
    return require(lab::bakeOfScene(shared, settings));
}

// What the engine has drawn in a frame, and what Rebound has made of it.
struct BakedFrame {
    Camera camera;
    LightSetup lights;
    lab::Image depth, normal, albedo, lit, shadowMap, indirect, composed;
};

// The joined plan on the scalar CPU, frame by frame.
class BakedLightOnCpu {
public:
    BakedLightOnCpu(const Bake& bake, const SurfelLightSettings& l, const IlluminanceCompositionSettings& s)
        : lights(l), settings(s) {
        for (size_t i = 0; i < sections.size(); ++i) sections[i] = runner::sharedBytes(bake.sections[i]);
        plan = require(planSurfelLight(lights));
        require(append(plan, require(planIlluminanceComposition(settings)), joining));
        runner::BackendChoice choice;
        choice.isa = cpu::Isa::scalar;
        backend = require(runner::createBackend(choice));
    }

    Light run(const BakedFrame& frame) {
        SurfelSources sources = surfelSourcesOf(frame.lights);
        SurfelLightFrame<lab::Image> surfels;
        surfels.sources = int(sources.sources.size());
        sources.sources.resize(size_t(lights.maximumSources));
        surfels.shadowMaps[0] = frame.shadowMap;
        surfels.surfels = sections[size_t(BakeSection::surfels)];
        surfels.lightSources = runner::sharedBytes(sources.sources);
        surfels.shadowViews = runner::sharedBytes(std::span(&sources.view, 1));
        IlluminanceCompositionFrame<lab::Image> composition;
        composition.camera = frame.camera;
        composition.depth = frame.depth;
        composition.normal = frame.normal;
        composition.albedo = frame.albedo;
        composition.lit = frame.lit;
        composition.sections = sections;
        auto inputs = require(surfelLightInputs(lights, surfels));
        require(append(inputs, require(illuminanceCompositionInputs(settings, composition)), joining));
        if (!prepared) prepared = require(backend->prepare(plan, inputs, {}));
        require(prepared->runFrame(inputs));
        return {require(prepared->read("indirect")), require(prepared->read("composed"))};
    }

private:
    SurfelLightSettings lights;
    IlluminanceCompositionSettings settings;
    AppendOptions joining{"", "", {{"surfel light", "surfel light"}}};
    std::array<SharedBytes, bakeSectionCount> sections;
    Plan plan;
    std::unique_ptr<runner::Backend> backend;
    std::unique_ptr<runner::PreparedPlan> prepared;
};

// Frames 38 to 42: the lamp goes out at frame 40.
inline constexpr int firstBakedFrame = 38, bakedFrames = 5;

// render(frame) renders one and hands it out. Both settle by one bounce a frame, from the first one on.
template <class Render>
void checkBakedFrames(const Bake& bake, const SurfelLightSettings& lights,
                      const IlluminanceCompositionSettings& settings, Render render) {
    BakedLightOnCpu cpu(bake, lights, settings);
    std::vector<double> means;
    for (int i = 0; i < bakedFrames; ++i) {
        const BakedFrame frame = render(firstBakedFrame + i);
        const Light expected = cpu.run(frame);
        CHECK(mean(frame.indirect) > 0.01 * mean(frame.lit)); // there is light to compare
        checkAgreement("indirect of frame " + std::to_string(i), frame.indirect, expected.indirect);
        checkAgreement("composed of frame " + std::to_string(i), frame.composed, expected.composed);
        means.push_back(mean(frame.indirect));
    }
    CHECK(means[1] > means[0]);        // a bounce more
    CHECK(means[2] < 0.75 * means[1]); // the lamp is out
}

} // namespace rebound::engine
