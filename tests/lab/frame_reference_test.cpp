// SPDX-License-Identifier: MIT
// Frames of real scenes against an independent renderer (Blender Cycles), pixel by pixel.
#include "lab/scenes/scene_files.hpp"

#include "frame_test_scene.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

using namespace rebound;
using namespace rebound::lab;

namespace {

struct View {
    const char* scene;
    const char* camera;
    bool hardLight; // only suns, points and spots: no noise on either side
};

constexpr View views[] = {
    {"arena", "underpass", false}, {"bridge_garden", "rail", false},   {"cornell_box", "front", false},
    {"fox_room", "front", true},   {"grate_hall", "beam", true},       {"jungle_hut", "overview", false},
    {"lava_room", "high", false},  {"living_room", "back_wall", true}, {"sponza", "arch", true},
};

// The share of values that agree to absolute + relative * the reference's, all channels of a pixel alike.
double agreement(const Image& image, const Image& reference, float absolute, float relative) {
    REQUIRE(image.extent() == reference.extent());
    REQUIRE(image.channels == reference.channels);
    int agreeing = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            bool same = true;
            for (int c = 0; c < image.channels; ++c) {
                const float expected = reference.at(x, y)[c];
                same = same &&
                       std::abs(image.at(x, y)[c] - expected) <= absolute + relative * std::abs(expected);
            }
            agreeing += same;
        }
    return double(agreeing) / (double(image.width) * double(image.height));
}

double mean(const Image& image) {
    double sum = 0.0;
    for (const float value : image.data) sum += double(value);
    return sum / double(image.data.size());
}

// Means over squares of that many pixels.
Image blockMeans(const Image& image, int size) {
    Image blocks({image.width / size, image.height / size}, image.channels);
    for (int y = 0; y < blocks.height * size; ++y)
        for (int x = 0; x < blocks.width * size; ++x)
            for (int c = 0; c < image.channels; ++c)
                blocks.at(x / size, y / size)[c] += image.at(x, y)[c] / float(size * size);
    return blocks;
}

void checkSurfaces(const Frame& frame, const Frame& reference) {
    // The pixels that differ see an edge, where one rounding puts the ray on another surface. Stored depth is
    // exact.
    CHECK(agreement(frame.depth, reference.depth, 0.0f, 1e-4f) > 0.999);
    // Halves resolve 0.0005; along hems of cloth and leaves the reference blends neighbouring normals.
    CHECK(agreement(frame.normal, reference.normal, 0.005f, 0.0f) > 0.98);
    // The reference filters texels before it decodes sRGB, so that it differs where neighbours do:
    // most, in 1 pixel of 20, on lava_room's floor of thin bright lines.
    CHECK(agreement(frame.albedo, reference.albedo, 0.1f, 0.0f) > 0.94);
    if (!reference.emission.empty())
        CHECK(agreement(frame.emission, reference.emission, 0.0f, 0.01f) > 0.999);
    CHECK(frame.emission.empty() == reference.emission.empty());
}

void checkDirect(const Frame& frame, const Frame& reference, bool hardLight) {
    const auto average = float(mean(reference.direct));
    // Edges of shadows, and pixels that see another surface.
    if (hardLight) CHECK(agreement(frame.direct, reference.direct, 0.001f * average, 0.01f) > 0.99);
    // Both sides are noisy in single pixels; means over 20 x 20 of them much less.
    CHECK(agreement(blockMeans(frame.direct, 20), blockMeans(reference.direct, 20), 0.03f * average, 0.05f) >
          0.97);
    // Edges of leaves and railings, which the reference's normals blend, are all that is left in the mean.
    CHECK(mean(frame.direct) == doctest::Approx(double(average)).scale(0.0).epsilon(0.005));
}

} // namespace

TEST_CASE("frames of real scenes agree with an independent renderer") {
    const char* shared = std::getenv("REBOUND_SHARED");
    if (!shared) {
        MESSAGE("skipped: REBOUND_SHARED does not name a folder with scenes and reference images");
        return;
    }
    const std::filesystem::path folder = shared;
    for (const View& view : views) {
        const std::string name = view.scene;
        CAPTURE(name);
        const auto scene = loadScene((folder / "scenes" / view.scene / "scene.gltf").string());
        REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
        const auto camera = findCamera(*scene, view.camera);
        REQUIRE(camera);
        const auto reference = readFrame(folder / "reference" / view.scene / view.camera);
        REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
        CHECK(reference->camera.position == camera->position);
        CHECK(reference->camera.verticalFieldOfView == camera->verticalFieldOfView);
        const Frame frame =
            rendered(*scene, *camera, {.extent = reference->depth.extent(), .lightSamples = 16});
        checkSurfaces(frame, *reference);
        checkDirect(frame, *reference, view.hardLight);
    }
}
