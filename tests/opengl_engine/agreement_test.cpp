// SPDX-License-Identifier: MIT
// The engine's pictures against the CPU device on the engine's own G-buffer, and against the lab's ray-cast frames.
#include "engine_run.hpp"

#include "lab/camera_matrices.hpp"
#include "lab/frame.hpp"
#include "lab/image_files.hpp"

namespace rebound::engine {
namespace {

// OpenGL leaves open which way a store rounds to half; llvmpipe's rounds towards zero, by 2^-11 of a value on average
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

// One frame of the engine, and the CPU device's on the G-buffer that is read back from it, rows as textures have them.
void checkIndirectLight(const lab::Scene& scene, const lab::CameraView& view, const std::string& preset) {
    auto context = openContext();
    const Extent2D size{320, 180};
    {
        const auto renderer = rendererFor(scene, size, view, preset);
        require(renderer->render(view));
        const Targets& t = renderer->targets();
        const lab::Image lit = require(renderer->read(t.lit, 3));
        const Light cpu = onCpu(renderer->indirectLight().settings(), cameraOf(view, size),
                                {{"depth", renderer->readDepth()},
                                 {"normal", require(renderer->read(t.normal, 3))},
                                 {"albedo", require(renderer->read(t.albedo, 3))},
                                 {"radiance", lit},
                                 {"lit", lit}});
        const lab::Image indirect = require(renderer->read(t.indirect, 3));
        CHECK(mean(indirect) > 0.02 * mean(lit)); // there is light to compare
        checkAgreement("indirect", indirect, cpu.indirect);
        checkAgreement("composed", require(renderer->read(t.composed, 3)), cpu.composed);
    }
    checkSilence(context);
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
        int different = 0;
        for (size_t i = 0; i < depth.data.size(); ++i) {
            // Normalised depth d = (p22 z + p32) / -z, for distance -z; stored as d / 2 + 1 / 2.
            const double device = 2.0 * double(depth.data[i]) - 1.0;
            const float distance = depth.data[i] < 1.0f ? float(p[3][2] / (device + p[2][2])) : 0.0f;
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
    checkSilence(context);
}

namespace {

// Through one tone curve: the mean of the differences of values 0 to 255, and the share of those above 32.
struct PictureDifference {
    double average = 0.0, far = 0.0;
};
PictureDifference pictureDifference(const lab::Image& image, const lab::Image& expected) {
    const lab::ToneCurve curve = lab::automaticToneCurve(expected);
    const lab::Picture a = lab::toneMap(image, curve), b = lab::toneMap(expected, curve);
    PictureDifference d;
    const double share = 1.0 / double(a.rgb.size());
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        const int e = std::abs(int(a.rgb[i]) - int(b.rgb[i]));
        d.average += e * share;
        d.far += e > 32 ? share : 0.0;
    }
    return d;
}

// A ray-cast frame's picture on the CPU, its rows from the top as the lab has them, or from the bottom as OpenGL has;
// handed back from the top.
lab::Image composedOnCpu(const lab::Frame& frame, const lab::CameraView& view, FirstRow firstRow) {
    const bool turned = firstRow == FirstRow::bottom;
    const auto rows = [&](const lab::Image& image) { return turned ? upsideDown(image) : image; };
    ScreenIndirectSettings settings = require(screenIndirectPreset("quarter-64", frame.depth.extent()));
    settings.conventions.firstRow = firstRow;
    const lab::Image outgoing = rows(lab::outgoingRadiance(frame));
    return rows(onCpu(settings, lab::cameraMatrices(view, frame.depth.extent()),
                      {{"depth", rows(frame.depth)}, {"normal", rows(frame.normal)}, {"albedo", rows(frame.albedo)},
                       {"radiance", outgoing}, {"lit", outgoing}})
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
        const PictureDifference same = pictureDifference(composed, fromBottom), other = pictureDifference(composed, fromTop);
        const PictureDifference ofRows = pictureDifference(fromBottom, fromTop);
        const double means = mean(composed) / mean(fromTop);
        MESSAGE("from the CPU's picture, rows from the bottom: ", same.average, " of 255 on average, ", 100.0 * same.far,
                " % of values by more than 32; from the top, as the command line has it: ", other.average, ", ",
                100.0 * other.far, " %; these two from each other: ", ofRows.average, ", ", 100.0 * ofRows.far,
                " %; means' ratio ", means);
        // The lamp's soft shadows are one hard shadow of its centre here, and its near field 16 discs; edges are
        // rasterised. That touches the shadows' rims, about a hundredth of the picture.
        CHECK(same.average < 2.5);
        CHECK(same.far < 0.02);
        // Samples have fixed places around a texel, in rows and columns of the image: with the rows turned over, they are
        // mirrored in the picture, and the noise of 64 of them a level is another.
        CHECK(other.average < 2.5 + ofRows.average);
        CHECK(other.far < 0.02 + ofRows.far);
        CHECK(ofRows.average < 4.0); // noise, not another picture
        CHECK(std::abs(means - 1.0) < 0.01);
    }
    checkSilence(context);
}

} // namespace rebound::engine
