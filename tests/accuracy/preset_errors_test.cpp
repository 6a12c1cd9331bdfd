// SPDX-License-Identifier: MIT
// The error of every preset against the truth, on two built-in views and the published ones, at the size of the latter.
// A size that people use: preset_errors_long_test.cpp.
#include "preset_record.hpp"
#include "take.hpp"

#include "lab/light/reference_cache.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <utility>

using namespace rebound;
using namespace rebound::accuracy;

namespace {

// First bounces of a built-in scene by the path tracer. Their noise, 10 to 14 % of the mean in single pixels, is the same
// every time, and little beside what screen space misses.
ReferenceView builtInView(const std::string& name, const std::string& cameraName) {
    const char* cache = std::getenv("REBOUND_REFERENCE_CACHE");
    if (!cache) throw std::runtime_error("REBOUND_REFERENCE_CACHE has to name a folder");
    constexpr Extent2D extent{320, 180};
    const lab::Scene scene = take(lab::loadScene(name));
    const lab::CameraView camera = take(lab::findCamera(scene, cameraName));
    lab::PathTracedLight light =
        take(lab::cachedReference(scene, camera, {.extent = extent, .bounces = 1, .samples = 128}, cache));
    return {name + "/" + camera.name,
            take(lab::renderFrame(scene, camera, {.extent = extent, .lightSamples = 64})),
            std::move(light.firstBounce),
            {},
            {}};
}

} // namespace

TEST_CASE("presets are as accurate as stated, no less and no more") {
    PresetRecord record(std::string(PRESET_RECORDS) + "/preset_errors.json");
    for (const auto& [scene, camera] : {std::pair{"builtin:cornell", "front"}, {"builtin:atrium", "nave"}})
        record.check(builtInView(scene, camera));
    const char* shared = std::getenv("REBOUND_SHARED");
    const std::vector<ReferenceView> published = loadReferenceViews(shared ? shared : "");
    if (published.empty())
        MESSAGE("published views are skipped: REBOUND_SHARED names no folder with reference/limits.json");
    for (const ReferenceView& view : published) record.check(view);
    std::cout << record.measured();
}
