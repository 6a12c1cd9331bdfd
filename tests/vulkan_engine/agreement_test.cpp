// SPDX-License-Identifier: MIT
// The engine's pictures against the CPU device on the engine's own G-buffer, and against the lab's ray-cast frames.
#include "../engine/agreement.hpp"
#include "engine_run.hpp"

#include "lab/scenes/camera_matrices.hpp"

namespace rebound::engine {
namespace {

// One frame of the engine, and the CPU device's on the G-buffer that is read back from it.
void checkFrame(const lab::Scene& scene, const lab::CameraView& view, const std::string& preset) {
    const auto context = openContext();
    const Extent2D size{320, 180};
    {
        const auto renderer = rendererFor(context, scene, size, view, preset);
        renderFrame(context, *renderer, 0, view);
        const Targets& t = renderer->targets();
        const auto read = [&](const auto& target) { return require(renderer->read(target, 3)); };
        const lab::Image lit = read(t.lit), radiance = read(t.radiance);
        checkIndirectLight(renderer->indirectLight().settings(),
                           {cameraOf(view, size), require(renderer->read(t.depth, 1)), read(t.normal),
                            radiance, read(t.albedo), lit, read(t.indirect), read(t.composed)});
    }
    checkSilence(context);
}

// The engine's picture and the one that `rebound render` makes of ray-cast images, through one tone curve.
void checkPicture(const lab::Scene& scene, const lab::CameraView& view) {
    const auto context = openContext();
    const Extent2D size{256, 192};
    lab::FrameOptions options;
    options.extent = size;
    const lab::Frame frame = require(lab::renderFrame(scene, view, options));
    const ScreenIndirectSettings settings = require(screenIndirectPreset("quarter-64", size));
    const lab::Image outgoing = lab::outgoingRadiance(frame);
    const Light expected = onCpu(settings, {lab::cameraMatrices(view, size),
                                            frame.depth,
                                            frame.normal,
                                            outgoing,
                                            frame.albedo,
                                            outgoing,
                                            {},
                                            {}});
    {
        const auto renderer = rendererFor(context, scene, size, view);
        renderFrame(context, *renderer, 0, view);
        const lab::Image composed = require(renderer->read(renderer->targets().composed, 3));
        const PictureDifference pictures = pictureDifference(composed, expected.composed);
        const Difference lit = difference(require(renderer->read(renderer->targets().lit, 3)), outgoing);
        const Difference indirect =
            difference(require(renderer->read(renderer->targets().indirect, 3)), expected.indirect);
        const double means = mean(composed) / mean(expected.composed);
        MESSAGE(view.name, ": pictures differ by ", pictures.average, " of 255 on average, ",
                100.0 * pictures.far,
                " % of values by more than 32; direct "
                "light by ",
                lit.average, " of its mean, indirect light by ", indirect.average, "; means' ratio ", means);
        CHECK(pictures.average < mostOfCornell.average);
        CHECK(pictures.far < mostOfCornell.far);
        CHECK(std::abs(means - 1.0) < 0.01);
        // Light from all around a texel hardly knows where a shadow's rim is.
        CHECK(indirect.average < 0.03);
    }
    checkSilence(context);
}

} // namespace

TEST_CASE("indirect light is the CPU device's on the engine's own G-buffer: the Cornell box") {
    const lab::Scene scene = lab::makeCornellBox();
    checkFrame(scene, scene.cameras.at(0), "quarter-64");
}

TEST_CASE("indirect light is the CPU device's on the engine's own G-buffer: the atrium") {
    const lab::Scene scene = lab::makeAtrium();
    checkFrame(scene, scene.cameras.at(0), "half-64");
}

TEST_CASE("indirect light is the CPU device's on the engine's own G-buffer: an orthographic camera") {
    const lab::Scene scene = lab::makeAtrium();
    checkFrame(scene, orthographicView(scene), "quarter-64");
}

TEST_CASE("the G-buffer is the lab's, but for edges") {
    const auto context = openContext();
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    const Extent2D size{256, 192};
    lab::FrameOptions options;
    options.extent = size;
    const lab::Frame expected = require(lab::renderFrame(scene, view, options));
    {
        const auto renderer = rendererFor(context, scene, size, view);
        renderFrame(context, *renderer, 0, view);
        const lab::Image depth = require(renderer->read(renderer->targets().depth, 1));
        const lab::Image normal = require(renderer->read(renderer->targets().normal, 3));
        const lab::Image albedo = require(renderer->read(renderer->targets().albedo, 3));
        lab::Image distance(size, 1);
        for (size_t i = 0; i < depth.data.size();
             ++i) // reversed depth is the near plane's distance over the surface's
            distance.data[i] = depth.data[i] > 0.0f ? view.nearPlane / depth.data[i] : 0.0f;
        checkGBuffer(distance, normal, albedo, expected);
    }
    checkSilence(context);
}

// The second camera is turned against the world's axes, so that world and view space differ.
TEST_CASE("the Cornell box looks as the command line renders it") {
    const lab::Scene scene = lab::makeCornellBox();
    for (const lab::CameraView& view : scene.cameras) checkPicture(scene, view);
}

} // namespace rebound::engine
