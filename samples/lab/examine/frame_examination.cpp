// SPDX-License-Identifier: MIT
#include "lab/examine/frame_examination.hpp"

#include "lab/runner/runner.hpp"
#include "lab/scenes/camera_matrices.hpp"

#include <algorithm>

namespace rebound::examine {

Result<std::vector<InputFinding>> examineFrame(const lab::Frame& frame, int threads) {
    if (auto complete = lab::validate(frame); !complete) return complete.error();
    InputCheckSettings settings;
    settings.resolution = frame.depth.extent();
    settings.emission = !frame.emission.empty() && !frame.emissionIsDirectLight; // it is in the radiance
    settings.motion = !frame.motion.empty();
    settings.conventions.projection =
        frame.camera.orthographic ? Projection::orthographic : Projection::perspective;
    const auto plan = planInputCheck(settings);
    if (!plan) return plan.error();
    InputCheckFrame<lab::Image> images;
    images.camera = lab::cameraMatrices(frame.camera, settings.resolution);
    images.depth = frame.depth;
    images.normal = frame.normal;
    images.albedo = frame.albedo;
    images.radiance = lab::gatheredRadiance(frame);
    if (settings.emission) images.emission = frame.emission;
    if (settings.motion) {
        images.previousCamera = lab::cameraMatrices(frame.previousCamera, settings.resolution);
        images.motion = frame.motion;
    }
    const auto inputs = inputCheckInputs(settings, images);
    // A camera that contradicts the conventions is a finding in itself.
    if (!inputs)
        return std::vector<InputFinding>{
            {InputProblem::camera, Certainty::mistake, 0.0, inputs.error().message}};

    runner::BackendChoice cpu;
    cpu.threads = threads;
    auto backend = runner::createBackend(cpu);
    if (!backend) return backend.error();
    auto prepared = (*backend)->prepare(*plan, *inputs, {runner::Precision::single, false});
    if (!prepared) return prepared.error();
    if (auto done = (*prepared)->run(); !done) return done.error();
    const auto written = (*prepared)->read("statistics");
    if (!written) return written.error();
    InputStatistics statistics{};
    std::copy_n(written->data.begin(), std::min(written->data.size(), statistics.size()), statistics.begin());
    return examineInputs(settings, images.camera, statistics);
}

} // namespace rebound::examine
