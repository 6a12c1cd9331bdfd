// SPDX-License-Identifier: MIT
// Light of all bounces through caches against the truth of an independent renderer, its noise taken out.
#pragma once

#include "reference_frames.hpp"
#include "take.hpp"

#include "lab/images/image_files.hpp"
#include "lab/measure/frame_pipeline.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rebound::accuracy {

struct BakedView {
    std::string name;
    ReferenceView reference; // its truth: of 1 to 8 bounces
    double noise = 0.0;      // of the truth: standard deviation over all channels, over the mean
    std::shared_ptr<const lab::Scene> scene;
};

inline double noiseOf(const std::filesystem::path& folder) {
    std::ifstream file(folder / "meta.json");
    const auto meta = nlohmann::json::parse(file);
    return meta.at("passes").at("indirect_8").at("noise_rms_rgb_relative").get<double>();
}

// Those of the reference views that `wanted` takes by name.
template <class Wanted>
std::vector<BakedView> bakedViews(const std::filesystem::path& shared, Wanted wanted) {
    std::vector<BakedView> views;
    for (ReferenceView& view : loadReferenceViews(shared)) {
        if (!wanted(view.name)) continue;
        const std::filesystem::path folder = shared / "reference" / view.name;
        const std::string scene = view.name.substr(0, view.name.find('/'));
        view.truth = take(lab::readExr(folder / "indirect_8.exr"));
        auto loaded = std::make_shared<const lab::Scene>(
            take(lab::loadScene((shared / "scenes" / scene / "scene.gltf").string())));
        views.push_back({view.name, std::move(view), noiseOf(folder), std::move(loaded)});
    }
    return views;
}

inline lab::Image composed(const BakedView& view, const techniques::Draft& draft) {
    const techniques::Technique& technique = *take(techniques::named("technique", "composition"));
    const lab::Frame& frame = view.reference.frame;
    auto configured = take(technique.parse(draft, techniques::viewOf(frame), techniques::Spelling::options));
    configured = take(techniques::completed(std::move(configured), {view.scene, 0, {}}, view.name));
    const auto backend = take(runner::createBackend({}));
    auto pipeline = take(
        measure::FramePipeline::create(frame, std::move(configured), *backend, runner::Precision::single));
    for (int i = 0; i < pipeline.technique().settlingFrames; ++i) take(pipeline.run());
    return take(pipeline.indirect());
}

// What the truth's noise adds to the squared error is the same for any result.
inline double withoutNoise(double relativeRmse, double noise) {
    return std::sqrt(std::max(0.0, relativeRmse * relativeRmse - noise * noise));
}

// Another compiler's or processor's roundings move surfels, and so caches and links: by less than this, of the error and of
// the mean.
constexpr double allowedChange = 0.1, allowedMeanChange = 0.02;

// Checks every view of that quality's record that `wanted` takes, both ways, and returns the mean of their errors; nothing
// where there are none.
template <class Wanted>
std::optional<double> checkComposition(const std::string& quality, Wanted wanted) {
    std::ifstream file(std::string(PRESET_RECORDS) + "/composition_errors.json");
    REQUIRE(file);
    const auto stated = nlohmann::ordered_json::parse(file).at(quality);
    const char* shared = std::getenv("REBOUND_SHARED");
    const std::vector<BakedView> views = bakedViews(
        shared ? shared : "", [&](const std::string& name) { return stated.contains(name) && wanted(name); });
    if (views.empty()) {
        MESSAGE("skipped: REBOUND_SHARED names no folder with reference/limits.json");
        return {};
    }
    std::printf("relRMSE without the truth's noise, and mean over the truth's\n");
    double sum = 0.0;
    for (const BakedView& view : views) {
        CAPTURE(view.name);
        const lab::Image mask = comparablePixels(view.reference.frame, view.reference.truth);
        const ImageError error = errorOf(composed(view, {{"quality", quality}}), view.reference, mask);
        const double relative = withoutNoise(error.relativeRmse, view.noise);
        std::printf("%-24s %6.3f %6.3f\n", view.name.c_str(), relative, error.mean);
        sum += relative;
        const double statedError = stated.at(view.name).at(0), statedMean = stated.at(view.name).at(1);
        CHECK(std::abs(relative - statedError) <= allowedChange * statedError);
        CHECK(std::abs(error.mean - statedMean) <= allowedMeanChange);
    }
    return sum / double(views.size());
}

} // namespace rebound::accuracy
