// SPDX-License-Identifier: MIT
// The three steps of an integration: images of the host, a compiled plan, and frames recorded with them.
#pragma once

#include "lab/rays/frame.hpp"
#include "lab/techniques/technique.hpp"

namespace rebound::measure {

class FramePipeline {
public:
    // Hands the frame's images to the backend and compiles the plan, which has to be for pictures like this one
    // (techniques::viewOf). The frame has to be valid, and the backend outlives the pipeline.
    static Result<FramePipeline> create(const lab::Frame&, techniques::Configured, runner::Backend&,
                                        runner::Precision);

    // The next frame of a sequence, of the same size and projection.
    Result<> setFrame(const lab::Frame&);

    // Runs one frame. Returns what it took [ms].
    Result<double> run() { return prepared->run(); }

    const std::vector<PassTiming>& timings() const { return prepared->timings(); } // of the last frame
    std::optional<double> recordingTime() const { return prepared->recordingTime(); }
    MemoryUse memoryUse() const { return prepared->memoryUse(); }
    const techniques::Configured& technique() const { return configured; }
    size_t limitedPixels() const { return limited; } // whose radiance was above what techniques take

    const lab::Image& direct() const { return outgoing; } // emission + albedo * E / pi of direct light
    Result<lab::Image> indirect() const { return prepared->read("indirect"); } // E / pi of indirect light
    Result<lab::Image> composed() const { return prepared->read("composed"); } // direct + albedo * indirect

private:
    Result<runner::PlanInputs> inputsOf(const lab::Frame&);
    void roundOutgoing();

    techniques::Configured configured;
    runner::Precision precision = runner::Precision::half;
    std::unique_ptr<runner::PreparedPlan> prepared;
    lab::Image outgoing;
    size_t limited = 0;
};

} // namespace rebound::measure
