// SPDX-License-Identifier: MIT
// The input check on real views and on the lab's own scenes.
#include "reference_frames.hpp"

#include "lab/scenes/camera_matrices.hpp"
#include "lab/scenes/scene_files.hpp"
#include "rebound/cpu/device.hpp"
#include "rebound/techniques/input_check.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

using namespace rebound;
using namespace rebound::accuracy;

namespace {

template <class T>
T take(Result<T> result) {
    REQUIRE_MESSAGE(result, (result ? "" : result.error().message));
    return std::move(*result);
}

cpu::Image imageOf(const lab::Image& i) {
    return cpu::interleavedImage(const_cast<float*>(i.data.data()), i.extent(), i.channels);
}

struct NamedFrame {
    std::string view; // scene/camera
    lab::Frame frame;
};

// The published views with all that they hold; empty where they are not there.
std::vector<NamedFrame> referenceFrames() {
    const char* shared = std::getenv("REBOUND_SHARED");
    const std::filesystem::path folder(shared ? shared : "");
    std::vector<NamedFrame> frames;
    for (const ReferenceView& view : loadReferenceViews(folder))
        frames.push_back({view.name, take(lab::readFrame(folder / "reference" / view.name))});
    return frames;
}

// Zero stays zero: there is nothing.
lab::Image changed(lab::Image normal, const std::function<glm::vec3(glm::vec3)>& change) {
    for (size_t i = 0; i < normal.data.size(); i += 3) {
        float* n = &normal.data[i];
        if (n[0] == 0.0f && n[1] == 0.0f && n[2] == 0.0f) continue;
        const glm::vec3 v = change({n[0], n[1], n[2]});
        for (int k = 0; k < 3; ++k) n[k] = v[k];
    }
    return normal;
}

// Depth as a distance along each pixel's ray, as ray tracers have it.
lab::Frame withRadialDepth(lab::Frame frame) {
    const Extent2D e = frame.depth.extent();
    const double tangent = std::tan(double(frame.camera.verticalFieldOfView) / 2.0),
                 aspect = double(e.width) / e.height;
    for (int y = 0; y < e.height; ++y)
        for (int x = 0; x < e.width; ++x) {
            const double rx = tangent * aspect * (2.0 * (x + 0.5) / e.width - 1.0),
                         ry = tangent * (1.0 - 2.0 * (y + 0.5) / e.height);
            frame.depth.at(x, y)[0] *= float(std::sqrt(1.0 + rx * rx + ry * ry));
        }
    return frame;
}

std::vector<InputFinding> check(const lab::Frame& frame, const lab::Image& radiance,
                                const lab::Image& normal) {
    InputCheckSettings settings;
    settings.resolution = frame.depth.extent();
    settings.emission = !frame.emission.empty();
    settings.conventions.projection =
        frame.camera.orthographic ? Projection::orthographic : Projection::perspective;
    cpu::DeviceOptions options;
    options.moreKernels = {cpu::inputCheckKernels};
    const cpu::Device device = take(cpu::Device::create(options));
    cpu::Program program = take(device.compile(take(planInputCheck(settings))));
    lab::Image statistics(inputStatisticsExtent, 4);
    InputCheckFrame<cpu::Image> inputs;
    inputs.camera = lab::cameraMatrices(frame.camera, settings.resolution);
    inputs.depth = imageOf(frame.depth);
    inputs.normal = imageOf(normal);
    inputs.albedo = imageOf(frame.albedo);
    inputs.radiance = imageOf(radiance);
    if (settings.emission) inputs.emission = imageOf(frame.emission);
    inputs.statistics = imageOf(statistics);
    take(program.record(take(inputCheckInputs(settings, inputs))));
    InputStatistics values{};
    std::copy(statistics.data.begin(), statistics.data.end(), values.begin());
    return examineInputs(settings, inputs.camera, values);
}

std::string sentences(const std::vector<InputFinding>& findings) {
    std::string text;
    for (const InputFinding& f : findings) text += std::string(name(f.problem)) + ": " + f.sentence + "\n";
    return text;
}

} // namespace

TEST_CASE("real views leave nothing to say, emission included") {
    const auto views = referenceFrames();
    if (views.empty()) {
        MESSAGE("skipped: REBOUND_SHARED names no folder with reference/limits.json");
        return;
    }
    for (const NamedFrame& named : views) {
        const auto findings = check(named.frame, lab::outgoingRadiance(named.frame), named.frame.normal);
        CHECK_MESSAGE(findings.empty(), named.view << "\n" << sentences(findings));
    }
}

TEST_CASE("built-in scenes leave nothing to say, in either projection") {
    for (const char* scene : {"builtin:cornell", "builtin:atrium"}) {
        const lab::Scene loaded = take(lab::loadScene(scene));
        for (lab::CameraView camera : loaded.cameras)
            for (bool orthographic : {false, true}) {
                camera.orthographic = orthographic;
                camera.orthographicHeight = 2.0f;
                const lab::Frame frame =
                    take(lab::renderFrame(loaded, camera, {.extent = {256, 144}, .lightSamples = 1}));
                const auto findings = check(frame, lab::outgoingRadiance(frame), frame.normal);
                CHECK_MESSAGE(findings.empty(), scene << " " << camera.name << "\n" << sentences(findings));
            }
    }
}

TEST_CASE("wrong inputs of real views are named") {
    const auto views = referenceFrames();
    if (views.empty()) {
        MESSAGE("skipped: REBOUND_SHARED names no folder with reference/limits.json");
        return;
    }
    int withoutAlbedo = 0;
    for (const NamedFrame& view : views) {
        CAPTURE(view.view);
        const lab::Frame& frame = view.frame;
        const lab::Image radiance = lab::outgoingRadiance(frame);
        const glm::mat3 toView(lab::cameraMatrices(frame.camera, frame.depth.extent()).view);
        const auto named = [&](InputProblem problem, const lab::Frame& f, const lab::Image& l,
                               const lab::Image& normal) {
            const auto findings = check(f, l, normal);
            INFO(sentences(findings));
            REQUIRE(findings.size() == 1);
            CHECK(std::string(name(findings[0].problem)) == name(problem));
        };
        named(InputProblem::normalsFlipped, frame, radiance,
              changed(frame.normal, [](glm::vec3 n) { return -n; }));
        named(InputProblem::normalsNotUnit, frame, radiance,
              changed(frame.normal, [](glm::vec3 n) { return 2.0f * n; }));
        named(InputProblem::normalsEncoding, frame, radiance,
              changed(frame.normal, [](glm::vec3 n) { return 0.5f * n + 0.5f; }));
        // A camera that looks along the world's axes has the same normals in both spaces.
        const bool differs = std::abs(toView[0].x) + std::abs(toView[1].y) + std::abs(toView[2].z) < 2.9f;
        if (differs)
            named(InputProblem::normalsSpace, frame, radiance,
                  changed(frame.normal, [&](glm::vec3 n) { return toView * n; }));
        named(InputProblem::depthEncoding, withRadialDepth(frame), radiance, frame.normal);
        for (const InputFinding& f : check(frame, frame.direct, frame.normal)) {
            INFO(f.sentence);
            CHECK(f.problem == InputProblem::radianceWithoutAlbedo);
            ++withoutAlbedo;
        }
    }
    // The views whose surfaces have textures of enough contrast: bridge_garden, jungle_hut, lava_room,
    // sponza.
    CHECK(withoutAlbedo == 4);
}
