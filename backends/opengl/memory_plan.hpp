// SPDX-License-Identifier: MIT
// What a plan takes: textures that transients share, buffers, and when the GPU has to wait for what.
#pragma once

#include "gl.hpp"

#include <array>
#include <vector>

namespace rebound::opengl {

// OpenGL cannot lay two textures over each other, so transients share one where format and size are the same
// and their lifetimes are disjoint.
struct TextureUse {
    Format format = Format::rgba16f;
    Extent2D extent;
    std::string label;       // the transients' names
    int lastPass = -1;       // of transients
    bool isShareable = true; // whether it is one of transients
};

// One object of OpenGL holds all buffers of a kind.
enum class BufferGroup { tables, frameConstants, transient, persistent, none };
BufferGroup bufferGroupOf(ResourceKind);

struct MemoryPlan {
    std::vector<TextureUse> textures; // of transients and of history
    std::vector<int> textureOf; // by resource: index into textures, of history the first of two; -1: none
    std::vector<size_t> bufferOffsets;      // by resource, in its group's buffer [bytes]
    std::array<size_t, 4> bufferSizes = {}; // by group [bytes]
    MemoryUse use;
};

// Of a valid plan.
MemoryPlan planMemory(const Plan&, size_t alignment);

// Bits of glMemoryBarrier before each pass, for what earlier passes and the frame before have left under way.
std::vector<GLbitfield> barriersBefore(const Plan&, const MemoryPlan&);

// For a host that samples, reads back, copies, or draws on what kernels of the plan wrote.
GLbitfield barrierForHost(const Plan&);

} // namespace rebound::opengl
