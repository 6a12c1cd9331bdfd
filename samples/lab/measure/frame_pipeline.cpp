// SPDX-License-Identifier: MIT
#include "lab/measure/frame_pipeline.hpp"

#include "lab/runner/texels.hpp"
#include "lab/scenes/camera_matrices.hpp"

#include <algorithm>

namespace rebound::measure {

namespace {

// The technique takes radiance up to half's largest value. Returns the number of pixels that were above.
size_t limitToRange(lab::Image& image) {
    size_t count = 0;
    for (size_t i = 0; i < image.data.size(); i += 3) {
        count += std::max({image.data[i], image.data[i + 1], image.data[i + 2]}) > runner::largestHalf;
        for (size_t c = 0; c < 3; ++c) image.data[i + c] = std::min(image.data[i + c], runner::largestHalf);
    }
    return count;
}

} // namespace

Result<FramePipeline> FramePipeline::create(const lab::Frame& frame, const ScreenIndirectSettings& requested,
                                            runner::Backend& backend, runner::Precision precision) {
    FramePipeline pipeline;
    pipeline.settings_ = requested;
    pipeline.settings_.conventions.projection =
        frame.camera.orthographic ? Projection::orthographic : Projection::perspective;
    auto plan = planScreenIndirect(pipeline.settings_);
    if (!plan) return plan.error();
    pipeline.outgoing = lab::outgoingRadiance(frame);
    pipeline.limited = limitToRange(pipeline.outgoing);
    // What is lit and what is sent differ only by emission that is direct light already.
    const bool isOne = frame.emission.empty() || !frame.emissionIsDirectLight;
    lab::Image sent = isOne ? lab::Image() : lab::gatheredRadiance(frame);
    limitToRange(sent);
    const Camera camera = lab::cameraMatrices(frame.camera, pipeline.settings_.resolution);
    auto inputs = screenIndirectInputs(pipeline.settings_,
                                       ScreenIndirectFrame<lab::Image>{camera,
                                                                       frame.depth,
                                                                       frame.normal,
                                                                       isOne ? pipeline.outgoing : sent,
                                                                       frame.albedo,
                                                                       pipeline.outgoing,
                                                                       {},
                                                                       {}});
    if (!inputs) return inputs.error();
    auto prepared = backend.prepare(*plan, *inputs, {precision, false});
    if (!prepared) return prepared.error();
    pipeline.prepared = *std::move(prepared);
    if (precision == runner::Precision::half) runner::roundTo(Format::rgba16f, pipeline.outgoing);
    return pipeline;
}

} // namespace rebound::measure
