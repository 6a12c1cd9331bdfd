// SPDX-License-Identifier: MIT
#include "path_tracer_agreement.hpp"
#include "take.hpp"

#include "lab/images/image_files.hpp"
#include "lab/light/path_tracer.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rebound::accuracy {
namespace {

// Means over squares of that many pixels, of those that can be compared.
lab::Image blockMeans(const lab::Image& image, const lab::Image& mask, int size) {
    lab::Image blocks({image.width / size, image.height / size}, 3);
    for (int y = 0; y < blocks.height; ++y)
        for (int x = 0; x < blocks.width; ++x) {
            int count = 0;
            for (int j = 0; j < size; ++j)
                for (int i = 0; i < size; ++i) {
                    if (*mask.at(x * size + i, y * size + j) == 0.0f) continue;
                    for (int c = 0; c < 3; ++c) blocks.at(x, y)[c] += image.at(x * size + i, y * size + j)[c];
                    ++count;
                }
            for (int c = 0; c < 3; ++c) blocks.at(x, y)[c] /= float(std::max(count, 1));
        }
    return blocks;
}

double meanOf(const lab::Image& image) {
    double sum = 0;
    for (const float value : image.data) sum += double(value);
    return sum / double(image.data.size());
}

lab::Image masked(lab::Image image, const lab::Image& mask) {
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] *= mask.data[i / 3];
    return image;
}

// Root of the mean squared difference over the reference's mean.
double relativeDifference(const lab::Image& image, const lab::Image& reference) {
    double squared = 0;
    for (size_t i = 0; i < image.data.size(); ++i)
        squared += std::pow(double(image.data[i]) - double(reference.data[i]), 2.0);
    return std::sqrt(squared / double(image.data.size())) / meanOf(reference);
}

struct Agreement {
    double mean = 0;       // ours over theirs
    double difference = 0; // of 4x4 blocks
};

Agreement agreementOf(const lab::Image& ours, const lab::Image& theirs, const lab::Image& mask) {
    return {meanOf(masked(ours, mask)) / meanOf(masked(theirs, mask)),
            relativeDifference(blockMeans(ours, mask, 4), blockMeans(theirs, mask, 4))};
}

// How far the mean may be off. 32 paths leave 0.2 % of a mean, and few bright ones in shade more of one bounce's. The
// reference filters lava_room's floor, thin bright lines on black, before it decodes sRGB, which makes it darker than
// filtering light: every bounce on it adds to that. Where living_room's doubled walls are black in the reference, they
// absorb what they should reflect.
double allowedMean(const std::string& view, int bounces) {
    if (view == "lava_room/high") return bounces == 0 ? 0.008 : bounces == 1 ? 0.02 : 0.035;
    if (view == "living_room/back_wall" && bounces == 8) return 0.015;
    return 0.008;
}

// Our noise in blocks of 16 pixels, theirs and that of single channels on top, and edges of leaves and railings, where the
// two see different surfaces.
double allowedDifference(const lab::PathTracedLight& light) {
    return 1.2 * light.relativeError / 4.0 + 0.065;
}

} // namespace

void checkPathTracer(const std::filesystem::path& shared, const std::set<std::string>& names) {
    std::vector<ReferenceView> views = loadReferenceViews(shared);
    if (views.empty()) {
        MESSAGE("skipped: REBOUND_SHARED names no folder with reference/limits.json");
        return;
    }
    if (!names.empty()) std::erase_if(views, [&](const ReferenceView& v) { return !names.contains(v.name); });
    REQUIRE((names.empty() || views.size() == names.size()));
    std::printf(
        "mean over the reference's, difference of 4x4 blocks over its mean\n%-22s %14s %14s %14s %8s\n",
        "view", "direct", "1 bounce", "8 bounces", "noise");
    for (const ReferenceView& view : views) {
        CAPTURE(view.name);
        const std::string scene = view.name.substr(0, view.name.find('/'));
        const lab::Scene loaded = take(lab::loadScene((shared / "scenes" / scene / "scene.gltf").string()));
        const lab::Image theirs = take(lab::readExr(shared / "reference" / view.name / "indirect_8.exr"));
        const lab::Image mask = comparablePixels(view.frame, theirs);
        const lab::PathTracedLight light = take(lab::tracePaths(
            loaded, view.frame.camera, {.extent = mask.extent(), .bounces = 8, .samples = 32}));
        const Agreement direct = agreementOf(light.direct, view.frame.direct, mask);
        const Agreement one = agreementOf(light.firstBounce, view.truth, mask);
        const Agreement eight = agreementOf(light.indirect, theirs, mask);
        std::printf("%-22s", view.name.c_str());
        for (const Agreement& a : {direct, one, eight}) std::printf("  %6.4f %5.3f", a.mean, a.difference);
        std::printf("  %6.3f\n", light.relativeError / 4.0);
        CHECK(std::abs(direct.mean - 1.0) < allowedMean(view.name, 0));
        CHECK(std::abs(one.mean - 1.0) < allowedMean(view.name, 1));
        CHECK(std::abs(eight.mean - 1.0) < allowedMean(view.name, 8));
        CHECK(eight.difference < allowedDifference(light));
    }
}

} // namespace rebound::accuracy
