// SPDX-License-Identifier: MIT
// The error of every preset against the truth at 1280x720, on the first view of four built-in scenes.
#include "preset_record.hpp"
#include "take.hpp"

#include "lab/light/path_tracer.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <iostream>

using namespace rebound;
using namespace rebound::accuracy;

namespace {

// 16 paths a pixel leave much noise in each, which the halves take out of the mean squared error: its own standard error
// is 0.3 % at most.
ReferenceView viewOf(const std::string& scene, const lab::Scene& loaded, const lab::CameraView& camera) {
    constexpr Extent2D extent{1280, 720};
    lab::PathTracedLight light =
        take(lab::tracePaths(loaded, camera, {.extent = extent, .bounces = 1, .samples = 16}));
    return {scene + "/" + camera.name,
            take(lab::renderFrame(loaded, camera, {.extent = extent, .lightSamples = 16})),
            std::move(light.firstBounce),
            std::move(light.firstBounceHalves),
            {}};
}

} // namespace

TEST_CASE("presets are as accurate at 1280x720 as stated, no less and no more") {
    PresetRecord record(std::string(PRESET_RECORDS) + "/preset_errors_1280x720.json");
    for (const std::string scene : {"builtin:atrium", "builtin:cornell", "builtin:study", "builtin:street"}) {
        const lab::Scene loaded = take(lab::loadScene(scene));
        record.check(viewOf(scene, loaded, loaded.cameras.at(0)), true);
    }
    std::cout << record.measured();
}
