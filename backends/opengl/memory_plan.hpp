// SPDX-License-Identifier: MIT
// What a plan takes: textures that transients share, buffers, and when the GPU has to wait for what.
#pragma once

#include "gl.hpp"

#include <vector>

namespace rebound::opengl {

// OpenGL cannot lay two textures over each other, so transients share one where format and size are the same
// and their lifetimes are disjoint.
struct TextureUse {
    Format format = Format::rgba16f;
    Extent2D extent;
    std::string label; // the transients' names
    int lastPass = -1;
};

struct MemoryPlan {
    std::vector<TextureUse> textures;
    std::vector<int> textureOf; // by resource: index into textures; -1: none
    std::vector<size_t>
        bufferOffsets;         // by resource, of buffers and of frame constants, each in a buffer of its own
    size_t buffers = 0;        // of the plan's buffers together [bytes]
    size_t frameConstants = 0; // together [bytes]
    MemoryUse use;
};

// Of a valid plan.
MemoryPlan planMemory(const Plan&, size_t alignment);

// Bits of glMemoryBarrier before each pass, for what earlier passes and the frame before have left under way.
std::vector<GLbitfield> barriersBefore(const Plan&, const MemoryPlan&);

// For a host that samples, reads back, copies, or draws on what kernels wrote.
inline constexpr GLbitfield barrierForHost = GL_TEXTURE_FETCH_BARRIER_BIT |
                                             GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                                             GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;

} // namespace rebound::opengl
