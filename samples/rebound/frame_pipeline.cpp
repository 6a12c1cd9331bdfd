// SPDX-License-Identifier: MIT
#include "frame_pipeline.hpp"

#include "lab/camera_matrices.hpp"
#include "options.hpp"

#include <algorithm>
#include <chrono>

namespace rebound::cli {

namespace {

// The technique takes radiance up to half's largest value. Returns the number of pixels that were above.
size_t limitToRange(lab::Image& image) {
    size_t count = 0;
    for (size_t i = 0; i < image.data.size(); i += 3) {
        count += std::max({image.data[i], image.data[i + 1], image.data[i + 2]}) > largestHalf;
        for (size_t c = 0; c < 3; ++c)
            image.data[i + c] = std::min(image.data[i + c], largestHalf);
    }
    return count;
}

} // namespace

Result<FramePipeline> FramePipeline::create(const lab::Frame& frame, const ScreenIndirectSettings& requested,
                                            const cpu::Device& device, cpu::Scalar precision) {
    ScreenIndirectSettings settings = requested;
    settings.conventions.projection =
        frame.camera.orthographic ? Projection::orthographic : Projection::perspective;
    auto plan = planOf(settings);
    if (!plan)
        return plan.error();
    auto program = device.compile(*plan);
    if (!program)
        return program.error();

    FramePipeline pipeline(settings, *std::move(program));
    lab::Image outgoing = lab::outgoingRadiance(frame);
    pipeline.limited = limitToRange(outgoing);
    pipeline.depth = HostImage(frame.depth, cpu::Scalar::float32);
    pipeline.normal = HostImage(frame.normal, precision);
    pipeline.albedo = HostImage(frame.albedo, precision);
    pipeline.radiance = HostImage(outgoing, precision);
    pipeline.indirect_ = HostImage(settings.resolution, 3, precision);
    pipeline.composed_ = HostImage(settings.resolution, 3, precision);

    ScreenIndirectFrame<cpu::Image> images;
    images.camera = lab::cameraMatrices(frame.camera, settings.resolution);
    images.depth = pipeline.depth.view();
    images.normal = pipeline.normal.view();
    images.albedo = pipeline.albedo.view();
    images.radiance = images.lit = pipeline.radiance.view();
    images.indirect = pipeline.indirect_.view();
    images.composed = pipeline.composed_.view();
    auto inputs = screenIndirectInputs(settings, images);
    if (!inputs)
        return inputs.error();
    pipeline.inputs = *std::move(inputs);
    return pipeline;
}

Result<double> FramePipeline::run() {
    const auto start = std::chrono::steady_clock::now();
    if (auto recorded = program.record(inputs); !recorded)
        return recorded.error();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace rebound::cli
