// SPDX-License-Identifier: MIT
// The engine's pictures against the CPU device on the engine's own G-buffer, and against the lab's ray-cast frames.
#include "../engine/agreement.hpp"
#include "engine_run.hpp"

#include "lab/scenes/camera_matrices.hpp"

namespace rebound::engine {
namespace {

// One frame of the engine, and the CPU device's on the G-buffer that is read back from it, rows as textures have them.
void checkFrame(const lab::Scene& scene, const lab::CameraView& view, const std::string& preset) {
    auto context = openContext();
    const Extent2D size{320, 180};
    {
        const auto renderer = rendererFor(scene, size, view, preset);
        require(renderer->render(view));
        const Targets& t = renderer->targets();
        const auto read = [&](const auto& target) { return require(renderer->read(target, 3)); };
        const lab::Image lit = read(t.lit), radiance = read(t.radiance);
        checkIndirectLight(renderer->indirectLight().settings(),
                           {cameraOf(view, size), renderer->readDepth(), read(t.normal), radiance,
                            read(t.albedo), lit, read(t.indirect), read(t.composed)});
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
    auto context = openContext();
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    const Extent2D size{256, 192};
    lab::FrameOptions options;
    options.extent = size;
    const lab::Frame expected = require(lab::renderFrame(scene, view, options));
    {
        const auto renderer = rendererFor(scene, size, view);
        require(renderer->render(view));
        const glm::dmat4 p(cameraOf(view, size).projection);
        const lab::Image depth = upsideDown(renderer->readDepth());
        const lab::Image normal = upsideDown(require(renderer->read(renderer->targets().normal, 3)));
        const lab::Image albedo = upsideDown(require(renderer->read(renderer->targets().albedo, 3)));
        lab::Image distance(size, 1);
        for (size_t i = 0; i < depth.data.size(); ++i) {
            // Normalised depth d = (p22 z + p32) / -z, for distance -z; stored as d / 2 + 1 / 2.
            const double device = 2.0 * double(depth.data[i]) - 1.0;
            distance.data[i] = depth.data[i] < 1.0f ? float(p[3][2] / (device + p[2][2])) : 0.0f;
        }
        checkGBuffer(distance, normal, albedo, expected);
    }
    checkSilence(context);
}

namespace {

// A ray-cast frame's picture on the CPU, its rows from the top as the lab has them, or from the bottom as OpenGL has;
// handed back from the top.
lab::Image composedOnCpu(const lab::Frame& frame, const lab::CameraView& view, FirstRow firstRow) {
    const bool turned = firstRow == FirstRow::bottom;
    const auto rows = [&](const lab::Image& image) { return turned ? upsideDown(image) : image; };
    ScreenIndirectSettings settings = require(screenIndirectPreset("quarter-64", frame.depth.extent()));
    settings.conventions.firstRow = firstRow;
    const lab::Image outgoing = rows(lab::outgoingRadiance(frame));
    return rows(onCpu(settings, {lab::cameraMatrices(view, frame.depth.extent()),
                                 rows(frame.depth),
                                 rows(frame.normal),
                                 outgoing,
                                 rows(frame.albedo),
                                 outgoing,
                                 {},
                                 {}})
                    .composed);
}

} // namespace

TEST_CASE("the Cornell box looks as the command line renders it") {
    auto context = openContext();
    const lab::Scene scene = lab::makeCornellBox();
    const lab::CameraView& view = scene.cameras.at(0);
    lab::FrameOptions options;
    options.extent = {256, 192};
    const lab::Frame frame = require(lab::renderFrame(scene, view, options));
    const lab::Image fromBottom = composedOnCpu(frame, view, FirstRow::bottom);
    const lab::Image fromTop = composedOnCpu(frame, view, FirstRow::top); // as `rebound render` does
    {
        const auto renderer = rendererFor(scene, options.extent, view);
        require(renderer->render(view));
        const lab::Image composed = upsideDown(require(renderer->read(renderer->targets().composed, 3)));
        const PictureDifference same = pictureDifference(composed, fromBottom),
                                other = pictureDifference(composed, fromTop);
        const PictureDifference ofRows = pictureDifference(fromBottom, fromTop);
        const double means = mean(composed) / mean(fromTop);
        MESSAGE("from the CPU's picture, rows from the bottom: ", same.average, " of 255 on average, ",
                100.0 * same.far,
                " % of values by more than 32; from the top, as the command line has it: ", other.average,
                ", ", 100.0 * other.far, " %; these two from each other: ", ofRows.average, ", ",
                100.0 * ofRows.far, " %; means' ratio ", means);
        CHECK(same.average < mostOfCornell.average);
        CHECK(same.far < mostOfCornell.far);
        // Samples have fixed places around a texel, in rows and columns of the image: with the rows turned over, they are
        // mirrored in the picture, and the noise of 64 of them a level is another.
        CHECK(other.average < mostOfCornell.average + ofRows.average);
        CHECK(other.far < mostOfCornell.far + ofRows.far);
        CHECK(ofRows.average < 4.0); // noise, not another picture
        CHECK(std::abs(means - 1.0) < 0.01);
    }
    checkSilence(context);
}

} // namespace rebound::engine
