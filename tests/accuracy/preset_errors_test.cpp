// SPDX-License-Identifier: MIT
// The error of every preset against the truth, on built-in and published views: a record that has to be kept. A change
// that makes a view worse fails, and so does one that makes it better, until preset_errors.json says so.
#include "reference_frames.hpp"

#include "lab/light/reference_cache.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

using namespace rebound;
using namespace rebound::accuracy;

namespace {

using Json = nlohmann::ordered_json;

// Compilers and instruction sets differ by less than 0.1 %; what is smaller than this shows in no picture.
constexpr double allowedChange = 0.01;

template <class T>
T take(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
}

// First bounces of the built-in scenes by the path tracer. Their noise, 10 to 14 % of the mean in single pixels, is the
// same every time, and little beside what screen space misses.
std::vector<ReferenceView> builtInViews() {
    const char* cache = std::getenv("REBOUND_REFERENCE_CACHE");
    if (!cache) throw std::runtime_error("REBOUND_REFERENCE_CACHE has to name a folder");
    constexpr Extent2D extent{320, 180};
    std::vector<ReferenceView> views;
    for (const char* name : {"builtin:cornell", "builtin:atrium"}) {
        const lab::Scene scene = take(lab::loadScene(name));
        for (const lab::CameraView& camera : scene.cameras) {
            lab::PathTracedLight light = take(
                lab::cachedReference(scene, camera, {.extent = extent, .bounces = 1, .samples = 128}, cache));
            ReferenceView view{std::string(name) + "/" + camera.name,
                               take(lab::renderFrame(scene, camera, {.extent = extent, .lightSamples = 64})),
                               std::move(light.firstBounce),
                               {}};
            views.push_back(std::move(view));
        }
    }
    return views;
}

Json measured(const ReferenceView& view) {
    Json errors;
    for (std::string_view preset : screenIndirectPresetNames()) {
        const auto settings = take(screenIndirectPreset(preset, view.frame.depth.extent()));
        const ImageError error = errorOf(gather(view, settings), view);
        errors[std::string(preset)] = {std::round(error.relativeRmse * 1e4) / 1e4,
                                       std::round(error.mean * 1e4) / 1e4};
    }
    return errors;
}

void checkUnchanged(double now, double stated, const char* what) {
    INFO(what, " is ", now, ", stated: ", stated);
    CHECK(std::abs(now - stated) <= allowedChange * stated);
}

} // namespace

TEST_CASE("presets are as accurate as stated, no less and no more") {
    std::ifstream file(PRESET_ERRORS);
    REQUIRE(file);
    const Json stated = Json::parse(file);
    const char* shared = std::getenv("REBOUND_SHARED");
    std::vector<ReferenceView> views = builtInViews();
    std::vector<ReferenceView> published = loadReferenceViews(shared ? shared : "");
    if (published.empty())
        MESSAGE("published views are skipped: REBOUND_SHARED names no folder with reference/limits.json");
    std::move(published.begin(), published.end(), std::back_inserter(views));
    Json all;
    for (const ReferenceView& view : views) {
        CAPTURE(view.name);
        all[view.name] = measured(view);
        CHECK_MESSAGE(stated.contains(view.name), "preset_errors.json does not hold this view");
        if (!stated.contains(view.name)) continue;
        for (const auto& [preset, error] : all[view.name].items()) {
            CAPTURE(preset);
            const Json& expected = stated.at(view.name).at(preset);
            checkUnchanged(error[0], expected[0], "relative RMSE");
            checkUnchanged(error[1], expected[1], "mean over the truth's mean");
        }
    }
    std::cout << "preset_errors.json as it is now:\n" << all.dump(1) << '\n';
}
