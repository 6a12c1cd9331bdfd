// SPDX-License-Identifier: MIT
// What a compiled plan consists of in OpenGL.
#pragma once

#include "memory_plan.hpp"
#include "pass_timer.hpp"
#include "shader_program.hpp"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace rebound::opengl {

struct Device::Shared {
    std::shared_ptr<const Gl> gl;
    bool timings = false;
    std::vector<std::span<const Shader* const>> shaders;
    // Programs that live somewhere: after a resize, new programs find those of the old ones.
    mutable std::map<std::pair<const Shader*, std::vector<int>>, std::weak_ptr<const ShaderProgram>> built;
};

struct CompiledPass {
    struct Slot {
        BindingKind kind = BindingKind::none;
        GLuint unit = 0;
        ResourceIndex resource = 0;
        Format format = Format::rgba16f; // of images that are written
        Access access = Access::read;
    };
    std::shared_ptr<const ShaderProgram> program;
    std::vector<Slot> slots;
    GLbitfield barrierBefore = 0;
    GLuint groups[2] = {};
};

struct Program::State {
    std::shared_ptr<const Device::Shared> device;
    std::shared_ptr<const Gl> gl;
    Plan plan;
    MemoryPlan memory;
    UnitCounts units;                  // the most that a pass uses
    std::vector<Format> outputFormats; // by resource, as kernels declare them
    std::vector<CompiledPass> passes;
    std::vector<Object> textures;  // as in memory.textures
    std::array<Object, 4> buffers; // by BufferGroup; none where nothing is in it
    GLbitfield barrierBehind = 0;  // for the host
    detail::FrameCount frames;
    int historyWritten = 0; // the texture of history that the latest frame has written
    // Nearest texel, no comparison: kernels fetch whole texels, and a texture's own sampler may make it
    // incomplete, as the default one does where there are no mip maps.
    Object sampler;
    mutable std::optional<PassTimer> timer;
    std::function<void(int)> passCallback;
};

} // namespace rebound::opengl
