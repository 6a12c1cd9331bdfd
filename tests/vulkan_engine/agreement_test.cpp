// SPDX-License-Identifier: MIT
// The engine's pictures against the CPU device on the engine's own G-buffer, and against the lab's ray-cast frames.
#include "engine_run.hpp"

#include "lab/camera_matrices.hpp"
#include "lab/frame.hpp"
#include "lab/image_files.hpp"

#include <cmath>

namespace rebound::engine {
namespace {

// Vulkan leaves open which way a store rounds to half; llvmpipe's rounds towards zero, by 2^-11 of a value on average
// and 2^-10 at most. Light passes through about a dozen stores on its way from the G-buffer to the result, each of them
// a little darker: the ratio of the means tells by how much. Beside it, sums are ordered differently, and halves are
// 2^-10 apart, in the output as well; and where two of four texels represent a coarser one equally well, last bits
// choose between them, and light moves a little around it.
constexpr double mostDarkening = 12.0 * 0x1p-11;
constexpr double mostOtherwise = 0x1p-10;

void checkAgreement(const std::string& what, lab::Image image, const lab::Image& expected) {
    const double ratio = mean(image) / mean(expected);
    for (float& value : image.data) value = float(double(value) / ratio);
    const Difference d = difference(image, expected);
    MESSAGE(what, ": means' ratio ", ratio, "; beside it ", d.average, " of the mean on average, ", d.root,
            " as root of the mean square, ", d.largest, " at most");
    CHECK(std::abs(ratio - 1.0) < mostDarkening);
    CHECK(d.average < mostOtherwise);
    CHECK(d.root < 4.0 * mostOtherwise);
}

// One frame of the engine, and the CPU device's on the G-buffer that is read back from it.
void checkIndirectLight(const lab::Scene& scene, const lab::CameraView& view, const std::string& preset) {
    const auto context = openContext();
    if (!context) return;
    const Extent2D size{320, 180};
    {
        const auto renderer = rendererFor(*context, scene, size, view, preset);
        renderFrame(*context, *renderer, 0, view);
        const Targets& t = renderer->targets();
        const lab::Image lit = require(renderer->read(t.lit, 3));
        const Light cpu = onCpu(renderer->indirectLight().settings(), cameraOf(view, size),
                                {{"depth", require(renderer->read(t.depth, 1))},
                                 {"normal", require(renderer->read(t.normal, 3))},
                                 {"albedo", require(renderer->read(t.albedo, 3))},
                                 {"radiance", lit},
                                 {"lit", lit}});
        const lab::Image indirect = require(renderer->read(t.indirect, 3));
        CHECK(mean(indirect) > 0.02 * mean(lit)); // there is light to compare
        checkAgreement("indirect", indirect, cpu.indirect);
        checkAgreement("composed", require(renderer->read(t.composed, 3)), cpu.composed);
    }
    checkSilence(*context);
}

// The engine's picture and the one that `rebound render` makes of ray-cast images, through one tone curve.
void checkPicture(const lab::Scene& scene, const lab::CameraView& view) {
    const auto context = openContext();
    if (!context) return;
    const Extent2D size{256, 192};
    lab::FrameOptions options;
    options.extent = size;
    const lab::Frame frame = require(lab::renderFrame(scene, view, options));
    const ScreenIndirectSettings settings = require(screenIndirectPreset("quarter-64", size));
    const lab::Image outgoing = lab::outgoingRadiance(frame);
    const Light expected = onCpu(settings, lab::cameraMatrices(view, size),
                                 {{"depth", frame.depth}, {"normal", frame.normal}, {"albedo", frame.albedo},
                                  {"radiance", outgoing}, {"lit", outgoing}});
    {
        const auto renderer = rendererFor(*context, scene, size, view);
        renderFrame(*context, *renderer, 0, view);
        const lab::Image composed = require(renderer->read(renderer->targets().composed, 3));
        const lab::ToneCurve curve = lab::automaticToneCurve(expected.composed);
        const lab::Picture a = lab::toneMap(composed, curve), b = lab::toneMap(expected.composed, curve);
        double sum = 0.0;
        int far = 0;
        for (size_t i = 0; i < a.rgb.size(); ++i) {
            const int e = std::abs(int(a.rgb[i]) - int(b.rgb[i]));
            sum += e;
            far += e > 32 ? 1 : 0;
        }
        const double average = sum / double(a.rgb.size()), share = double(far) / double(a.rgb.size());
        const Difference lit = difference(require(renderer->read(renderer->targets().lit, 3)), outgoing);
        const Difference indirect = difference(require(renderer->read(renderer->targets().indirect, 3)), expected.indirect);
        const double means = mean(composed) / mean(expected.composed);
        MESSAGE(view.name, ": pictures differ by ", average, " of 255 on average, ", 100.0 * share, " % of values by more than 32; direct "
                "light by ", lit.average, " of its mean, indirect light by ", indirect.average, "; means' ratio ", means);
        // The lamp's soft shadows are one hard shadow of its centre here, and its near field 16 discs; edges are
        // rasterised. That touches the shadows' rims, about a hundredth of the picture.
        CHECK(average < 2.5);
        CHECK(share < 0.02);
        CHECK(std::abs(means - 1.0) < 0.01);
        // Light from all around a texel hardly knows where a shadow's rim is.
        CHECK(indirect.average < 0.03);
    }
    checkSilence(*context);
}

} // namespace

TEST_CASE("indirect light is the CPU device's on the engine's own G-buffer: the Cornell box") {
    const lab::Scene scene = lab::makeCornellBox();
    checkIndirectLight(scene, scene.cameras.at(0), "quarter-64");
}

TEST_CASE("indirect light is the CPU device's on the engine's own G-buffer: the atrium") {
    const lab::Scene scene = lab::makeAtrium();
    checkIndirectLight(scene, scene.cameras.at(0), "half-64");
}

TEST_CASE("indirect light is the CPU device's on the engine's own G-buffer: an orthographic camera") {
    const lab::Scene scene = lab::makeAtrium();
    lab::CameraView view = scene.cameras.at(0);
    view.position.y = 8.0f; // looks down into the court: seen straight on, walls and floor would be edges
    view.orthographic = true;
    view.orthographicHeight = 8.0f;
    view.farPlane = 40.0f;
    checkIndirectLight(scene, view, "quarter-64");
}

TEST_CASE("the G-buffer is the lab's, but for edges") {
    const auto context = openContext();
    if (!context) return;
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    const Extent2D size{256, 192};
    lab::FrameOptions options;
    options.extent = size;
    const lab::Frame expected = require(lab::renderFrame(scene, view, options));
    {
        const auto renderer = rendererFor(*context, scene, size, view);
        renderFrame(*context, *renderer, 0, view);
        const lab::Image depth = require(renderer->read(renderer->targets().depth, 1));
        const lab::Image normal = require(renderer->read(renderer->targets().normal, 3));
        const lab::Image albedo = require(renderer->read(renderer->targets().albedo, 3));
        int different = 0;
        for (size_t i = 0; i < depth.data.size(); ++i) {
            // Reversed depth is the near plane's distance over the surface's.
            const float distance = depth.data[i] > 0.0f ? view.nearPlane / depth.data[i] : 0.0f;
            bool same = std::abs(distance - expected.depth.data[i]) <= 1e-4f * expected.depth.data[i];
            for (size_t c = 0; c < 3; ++c) // halves
                same = same && std::abs(normal.data[3 * i + c] - expected.normal.data[3 * i + c]) < 1e-3f &&
                       std::abs(albedo.data[3 * i + c] - expected.albedo.data[3 * i + c]) < 1e-3f;
            different += same ? 0 : 1;
        }
        MESSAGE(different, " of ", depth.data.size(), " pixels differ from the lab's G-buffer");
        // Where an edge passes through a pixel's centre, rasterisation and rays may decide differently.
        CHECK(different < int(depth.data.size() / 200));
    }
    checkSilence(*context);
}

// The second camera is turned against the world's axes, so that world and view space differ.
TEST_CASE("the Cornell box looks as the command line renders it") {
    const lab::Scene scene = lab::makeCornellBox();
    for (const lab::CameraView& view : scene.cameras) checkPicture(scene, view);
}

} // namespace rebound::engine
