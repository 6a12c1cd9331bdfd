// SPDX-License-Identifier: MIT
#include "lab/measure/frame_pipeline.hpp"

#include "lab/runner/texels.hpp"

#include <algorithm>

namespace rebound::measure {

namespace {

// Techniques take radiance up to half's largest value. Returns the number of pixels that were above.
size_t limitToRange(lab::Image& image) {
    size_t count = 0;
    for (size_t i = 0; i < image.data.size(); i += 3) {
        count += std::max({image.data[i], image.data[i + 1], image.data[i + 2]}) > runner::largestHalf;
        for (size_t c = 0; c < 3; ++c) image.data[i + c] = std::min(image.data[i + c], runner::largestHalf);
    }
    return count;
}

} // namespace

Result<runner::PlanInputs> FramePipeline::inputsOf(const lab::Frame& frame) {
    outgoing = lab::outgoingRadiance(frame);
    limited = limitToRange(outgoing);
    return configured.inputs(frame, outgoing);
}

// As the technique got it.
void FramePipeline::roundOutgoing() {
    if (precision == runner::Precision::half) runner::roundTo(Format::rgba16f, outgoing);
}

Result<FramePipeline> FramePipeline::create(const lab::Frame& frame, techniques::Configured technique,
                                            runner::Backend& backend, runner::Precision precision) {
    FramePipeline pipeline;
    pipeline.configured = std::move(technique);
    pipeline.precision = precision;
    auto inputs = pipeline.inputsOf(frame);
    if (!inputs) return inputs.error();
    auto prepared = backend.prepare(pipeline.configured.plan, *inputs, {precision, false});
    if (!prepared) return prepared.error();
    pipeline.prepared = *std::move(prepared);
    pipeline.roundOutgoing();
    return pipeline;
}

Result<> FramePipeline::setFrame(const lab::Frame& frame) {
    auto inputs = inputsOf(frame);
    if (!inputs) return inputs.error();
    roundOutgoing();
    return prepared->setInputs(*inputs);
}

} // namespace rebound::measure
