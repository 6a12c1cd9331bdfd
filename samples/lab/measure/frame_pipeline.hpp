// SPDX-License-Identifier: MIT
// The three steps of an integration: images of the host, a compiled plan, and frames recorded with them.
#pragma once

#include "lab/rays/frame.hpp"
#include "lab/runner/runner.hpp"
#include "rebound/techniques/screen_indirect.hpp"

namespace rebound::measure {

class FramePipeline {
public:
    // Hands the frame's images to the backend and compiles the plan. The frame has to be valid, and the backend outlives
    // the pipeline.
    static Result<FramePipeline> create(const lab::Frame&, const ScreenIndirectSettings&, runner::Backend&,
                                        runner::Precision);

    // Runs one frame. Returns what it took [ms].
    Result<double> run() { return prepared->run(); }

    const std::vector<PassTiming>& timings() const { return prepared->timings(); } // of the last frame
    std::optional<double> recordingTime() const { return prepared->recordingTime(); }
    MemoryUse memoryUse() const { return prepared->memoryUse(); }
    const ScreenIndirectSettings& settings() const { return settings_; }
    size_t limitedPixels() const { return limited; } // whose radiance was above what the technique takes

    const lab::Image& direct() const { return outgoing; } // emission + albedo * E / pi of direct light
    Result<lab::Image> indirect() const { return prepared->read("indirect"); } // E / pi of indirect light
    Result<lab::Image> composed() const { return prepared->read("composed"); } // direct + albedo * indirect

private:
    ScreenIndirectSettings settings_;
    std::unique_ptr<runner::PreparedPlan> prepared;
    lab::Image outgoing;
    size_t limited = 0;
};

} // namespace rebound::measure
