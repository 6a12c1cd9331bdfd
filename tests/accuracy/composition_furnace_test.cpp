// SPDX-License-Identifier: MIT
// A closed room whose surfaces all emit and reflect alike: its radiance is emission / (1 - albedo), wherever one looks.
#include "take.hpp"

#include "lab/measure/frame_pipeline.hpp"
#include "lab/scenes/scene_builder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

namespace rebound::accuracy {
namespace {

constexpr float albedo = 0.8f, emission = 0.2f; // together, a radiance of 1

// 6 x 3 x 5 m inside, with walls of 0.2 m, a block on the floor, a slab that hangs, and a pillar in a corner.
std::shared_ptr<const lab::Scene> furnace() {
    lab::SceneBuilder builder("furnace");
    lab::MeshBuilder& walls = builder.surface("walls", glm::vec3(albedo));
    const float t = 0.2f;
    walls.box({-t, -t, -t}, {6 + t, 0, 5 + t});
    walls.box({-t, 3, -t}, {6 + t, 3 + t, 5 + t});
    walls.box({-t, 0, -t}, {0, 3, 5 + t});
    walls.box({6, 0, -t}, {6 + t, 3, 5 + t});
    walls.box({0, 0, -t}, {6, 3, 0});
    walls.box({0, 0, 5}, {6, 3, 5 + t});
    lab::MeshBuilder& things = builder.surface("things", glm::vec3(albedo));
    things.box({2.1f, 0, 1.3f}, {3.2f, 0.9f, 2.2f});
    things.box({3.4f, 1.6f, 0.7f}, {5.1f, 1.7f, 2.9f});
    things.box({0, 0, 0}, {0.35f, 3, 0.35f});
    builder.camera("corner", {5.6f, 1.9f, 4.6f}, {1.5f, 0.9f, 0.8f}, 70.0f, 0.1f, 20.0f);
    lab::Scene scene = builder.take();
    for (lab::Material& material : scene.materials) material.emission = glm::vec3(emission);
    scene.emissiveMaterialsLight = false; // their light is the bake's
    return std::make_shared<const lab::Scene>(std::move(scene));
}

struct Deviation {
    double mean = 0, largest = 0, rootMeanSquare = 0; // from 1
    double beyond = 0;                                // share of the picture that is more than 2 % off
};

Deviation deviationOf(const lab::Image& light, size_t frames) {
    Deviation deviation;
    for (const float value : light.data) {
        const double off = double(value) - 1.0;
        deviation.mean += off / double(light.data.size());
        deviation.rootMeanSquare += off * off / double(light.data.size());
        deviation.largest = std::max(deviation.largest, std::abs(off));
        deviation.beyond += (std::abs(off) > 0.02) / double(light.data.size());
    }
    deviation.rootMeanSquare = std::sqrt(deviation.rootMeanSquare);
    std::printf("after %zu frames: mean %+.4f, root mean square %.4f, largest %.4f, beyond 2 %% %.5f\n",
                frames, deviation.mean, deviation.rootMeanSquare, deviation.largest, deviation.beyond);
    return deviation;
}

// After 8 frames, a bounce each, and after 40.
std::array<Deviation, 2> deviations() {
    const std::shared_ptr<const lab::Scene> scene = furnace();
    const lab::Frame frame = take(lab::renderFrame(*scene, scene->cameras.front(), {.extent = {640, 360}}));
    const techniques::Technique& technique = *take(techniques::named("technique", "composition"));
    const techniques::Draft draft{{"surfels", "8000"}, {"caches", "3000"}};
    auto configured = take(technique.parse(draft, techniques::viewOf(frame), techniques::Spelling::options));
    configured = take(techniques::completed(std::move(configured), {scene, 0, {}}, "furnace"));
    const auto backend = take(runner::createBackend({}));
    auto pipeline = take(
        measure::FramePipeline::create(frame, std::move(configured), *backend, runner::Precision::single));
    constexpr std::array<size_t, 2> frames{8, 40};
    std::array<Deviation, 2> after;
    size_t run = 0;
    for (size_t i = 0; i < after.size(); ++i) {
        for (; run < frames[i]; ++run) take(pipeline.run());
        after[i] = deviationOf(take(pipeline.indirect()), run);
    }
    return after;
}

} // namespace

TEST_CASE("a closed furnace of albedo 0.8 keeps its light once bounces have settled") {
    // 0.8^40 of the light is still missing: less than 0.02 %. Shapes of links are rounded to 8 bits, and every bounce adds to
    // what a cache is off.
    const auto [early, settled] = deviations();
    CHECK(std::abs(settled.mean) < 0.005);
    CHECK(settled.rootMeanSquare < 0.005);
    CHECK(settled.beyond < 0.002);
    CHECK(settled.largest < 0.03);
    // The control: what eight bounces leave out is seen.
    CHECK(early.mean == doctest::Approx(-std::pow(0.8, 8)).epsilon(0.05));
}

} // namespace rebound::accuracy
