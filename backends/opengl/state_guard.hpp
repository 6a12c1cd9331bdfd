// SPDX-License-Identifier: MIT
// The host's state that a device touches, put back at the end of a scope.
#pragma once

#include "gl.hpp"

#include <vector>

namespace rebound::opengl {

// How many units of each kind are used, from 0 on.
struct UnitCounts {
    int textures = 0, images = 0, uniformBlocks = 0, storageBlocks = 0;
};

class StateGuard {
public:
    StateGuard(const Gl&, const UnitCounts&);
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

private:
    struct TextureUnit {
        GLuint texture = 0, sampler = 0;
    };
    struct ImageUnit {
        GLuint texture = 0;
        GLint level = 0, layered = 0, layer = 0, access = 0, format = 0;
    };
    struct BufferRange {
        GLuint buffer = 0;
        GLint64 start = 0, size = 0; // size 0: the whole buffer
    };
    struct BufferBindings {
        GLenum target = 0;
        GLuint generic = 0;
        std::vector<BufferRange> indexed;
    };
    BufferBindings saved(GLenum target, GLenum binding, GLenum start, GLenum size, int count) const;
    void restore(const BufferBindings&) const;

    const Gl& gl;
    GLuint program = 0;
    GLenum activeTexture = 0;
    std::vector<TextureUnit> textureUnits;
    std::vector<ImageUnit> imageUnits;
    BufferBindings uniformBuffers, storageBuffers;
};

} // namespace rebound::opengl
