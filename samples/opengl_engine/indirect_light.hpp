// SPDX-License-Identifier: MIT
// Rebound within the engine: all that concerns it is here, in indirect_light.cpp, in conventionsOf(), and between the
// marks in renderer.cpp.
#pragma once

#include "rebound/opengl/device.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <optional>
#include <string>

namespace rebound::engine {

class IndirectLight {
public:
    // Once, with the context current.
    static Result<IndirectLight> create(opengl::Loader, bool timings);

    // At the start and after a resize. After a failure the program is the one before.
    Result<> compile(const std::string& preset, const GBufferConventions&, Extent2D);

    // Every frame.
    Result<> record(const ScreenIndirectFrame<opengl::Image>&);

    // Of the passes of the latest frame that the GPU has finished.
    Result<std::vector<PassTiming>> timings() const { return program->timings(); }
    MemoryUse memoryUse() const { return program->memoryUse(); }
    const ScreenIndirectSettings& settings() const { return current; }

private:
    explicit IndirectLight(opengl::Device d) : device(std::move(d)) {}

    opengl::Device device;
    ScreenIndirectSettings current;
    std::optional<opengl::Program> program;
};

} // namespace rebound::engine
