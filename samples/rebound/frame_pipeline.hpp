// SPDX-License-Identifier: MIT
// The three steps of an integration: images of the host, a compiled plan, and frames recorded with them.
#pragma once

#include "host_image.hpp"
#include "lab/frame.hpp"
#include "rebound/techniques/screen_indirect.hpp"

namespace rebound::cli {

class FramePipeline {
public:
    // Copies the frame's images to the host's layout and compiles the plan. The frame has to be valid.
    static Result<FramePipeline> create(const lab::Frame&, const ScreenIndirectSettings&, const cpu::Device&,
                                        cpu::Scalar precision);

    // Runs one frame. Returns what it took [ms].
    Result<double> run();

    const std::vector<PassTiming>& timings() const { return program.timings(); } // of the last frame
    MemoryUse memoryUse() const { return program.memoryUse(); }
    const ScreenIndirectSettings& settings() const { return settings_; }
    size_t limitedPixels() const { return limited; } // whose radiance was above what the technique takes

    lab::Image direct() const { return radiance.toLabImage(); } // emission + albedo * E / pi of direct light
    lab::Image indirect() const { return indirect_.toLabImage(); } // E / pi of indirect light
    lab::Image composed() const { return composed_.toLabImage(); } // direct + albedo * indirect

private:
    FramePipeline(const ScreenIndirectSettings& settings, cpu::Program compiled)
        : settings_(settings), program(std::move(compiled)) {}

    ScreenIndirectSettings settings_;
    cpu::Program program;
    HostImage depth, normal, albedo, radiance, indirect_, composed_;
    FrameInputs<cpu::Image> inputs;
    size_t limited = 0;
};

} // namespace rebound::cli
