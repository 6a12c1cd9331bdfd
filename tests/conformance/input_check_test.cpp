// SPDX-License-Identifier: MIT
// The input check finds the same on every backend of this machine.
#include "lab/rays/frame.hpp"
#include "lab/runner/runner.hpp"
#include "lab/scenes/camera_matrices.hpp"
#include "lab/scenes/scene_files.hpp"
#include "rebound/techniques/input_check.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace rebound;

namespace {

constexpr Extent2D extent{320, 180};

struct Subject {
    InputCheckSettings settings;
    Camera camera;
    lab::Frame frame;
};

Subject cornell() {
    const auto scene = lab::loadScene("builtin:cornell");
    REQUIRE(scene);
    const auto view = lab::findCamera(*scene, "");
    REQUIRE(view);
    lab::FrameOptions options;
    options.extent = extent;
    options.lightSamples = 4;
    auto frame = lab::renderFrame(*scene, *view, options);
    REQUIRE(frame);
    Subject subject;
    subject.settings.resolution = extent;
    subject.settings.emission = true;
    subject.camera = lab::cameraMatrices(*view, extent);
    subject.frame = *std::move(frame);
    if (subject.frame.emission.empty()) subject.frame.emission = lab::Image(extent, 3);
    return subject;
}

InputStatistics measure(const Subject& subject, runner::Backend& backend) {
    const lab::Frame& f = subject.frame;
    InputCheckFrame<lab::Image> frame;
    frame.camera = subject.camera;
    frame.depth = f.depth;
    frame.normal = f.normal;
    frame.albedo = f.albedo;
    frame.radiance = lab::outgoingRadiance(f);
    frame.emission = f.emission;
    const auto inputs = inputCheckInputs(subject.settings, frame);
    REQUIRE_MESSAGE(inputs, (inputs ? "" : inputs.error().message));
    const auto plan = planInputCheck(subject.settings);
    REQUIRE(plan);
    auto prepared = backend.prepare(*plan, *inputs, {runner::Precision::single, false});
    REQUIRE_MESSAGE(prepared, (prepared ? "" : prepared.error().message));
    REQUIRE((*prepared)->run());
    const auto image = (*prepared)->read("statistics");
    REQUIRE(image);
    InputStatistics statistics;
    REQUIRE(image->data.size() == statistics.size());
    std::copy(image->data.begin(), image->data.end(), statistics.begin());
    return statistics;
}

std::vector<InputProblem> problems(const Subject& subject, const InputStatistics& statistics) {
    std::vector<InputProblem> found;
    for (const InputFinding& finding : examineInputs(subject.settings, subject.camera, statistics))
        found.push_back(finding.problem);
    return found;
}

void checkEverywhere(const Subject& subject, const std::vector<InputProblem>& expected) {
    runner::BackendChoice scalar;
    scalar.isa = cpu::Isa::scalar;
    const InputStatistics reference = measure(subject, **runner::createBackend(scalar));
    CHECK(problems(subject, reference) == expected);
    for (const std::string& name : runner::backendNames()) {
        CAPTURE(name);
        runner::BackendChoice choice;
        choice.backend = name;
        choice.validation = true;
        auto backend = runner::createBackend(choice);
        if (!backend) {
            MESSAGE("skipped: " << backend.error().message);
            continue;
        }
        const InputStatistics other = measure(subject, **backend);
        CHECK(problems(subject, other) == expected);
        // Reciprocals to a few units in the last place tip a pixel in some hundred over a threshold.
        for (size_t i = 0; i < other.size(); ++i)
            CHECK(std::abs(other[i] - reference[i]) <= 3e-3f * float(extent.width * extent.height));
        for (const std::string& complaint : (*backend)->complaints()) FAIL_CHECK(complaint);
    }
}

} // namespace

TEST_CASE("a right frame is silent on every backend") { checkEverywhere(cornell(), {}); }

TEST_CASE("a wrong frame is named on every backend") {
    Subject subject = cornell();
    for (float& component : subject.frame.normal.data) component = -component;
    checkEverywhere(subject, {InputProblem::normalsFlipped});
}
