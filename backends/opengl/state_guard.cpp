// SPDX-License-Identifier: MIT
#include "state_guard.hpp"

namespace rebound::opengl {

StateGuard::StateGuard(const Gl& functions, const UnitCounts& counts) : gl(functions) {
    program = GLuint(gl.integer(GL_CURRENT_PROGRAM));
    activeTexture = GLenum(gl.integer(GL_ACTIVE_TEXTURE));
    for (int i = 0; i < counts.textures; ++i) {
        gl.ActiveTexture(GL_TEXTURE0 + GLenum(i));
        textureUnits.push_back(
            {GLuint(gl.integer(GL_TEXTURE_BINDING_2D)), GLuint(gl.integer(GL_SAMPLER_BINDING))});
    }
    for (GLuint i = 0; i < GLuint(counts.images); ++i) {
        const auto get = [&](GLenum name) {
            GLint value = 0;
            gl.GetIntegeri_v(name, i, &value);
            return value;
        };
        imageUnits.push_back({GLuint(get(GL_IMAGE_BINDING_NAME)), get(GL_IMAGE_BINDING_LEVEL),
                              get(GL_IMAGE_BINDING_LAYERED), get(GL_IMAGE_BINDING_LAYER),
                              get(GL_IMAGE_BINDING_ACCESS), get(GL_IMAGE_BINDING_FORMAT)});
    }
    uniformBuffers = saved(GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                           GL_UNIFORM_BUFFER_SIZE, counts.uniformBlocks);
    storageBuffers =
        saved(GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
              GL_SHADER_STORAGE_BUFFER_SIZE, counts.storageBlocks);
}

StateGuard::~StateGuard() {
    gl.UseProgram(program);
    for (size_t i = 0; i < textureUnits.size(); ++i) {
        gl.ActiveTexture(GL_TEXTURE0 + GLenum(i));
        gl.BindTexture(GL_TEXTURE_2D, textureUnits[i].texture);
        gl.BindSampler(GLuint(i), textureUnits[i].sampler);
    }
    gl.ActiveTexture(activeTexture);
    for (size_t i = 0; i < imageUnits.size(); ++i) {
        const ImageUnit& u = imageUnits[i];
        gl.BindImageTexture(GLuint(i), u.texture, u.level, u.layered ? GL_TRUE : GL_FALSE, u.layer,
                            GLenum(u.access), GLenum(u.format));
    }
    restore(uniformBuffers);
    restore(storageBuffers);
}

StateGuard::BufferBindings StateGuard::saved(GLenum target, GLenum binding, GLenum start, GLenum size,
                                             int count) const {
    BufferBindings bindings{target, GLuint(gl.integer(binding)), {}};
    for (GLuint i = 0; i < GLuint(count); ++i) {
        BufferRange range;
        GLint buffer = 0;
        gl.GetIntegeri_v(binding, i, &buffer);
        gl.GetInteger64i_v(start, i, &range.start);
        gl.GetInteger64i_v(size, i, &range.size);
        range.buffer = GLuint(buffer);
        bindings.indexed.push_back(range);
    }
    return bindings;
}

void StateGuard::restore(const BufferBindings& bindings) const {
    for (size_t i = 0; i < bindings.indexed.size(); ++i) {
        const BufferRange& range = bindings.indexed[i];
        if (range.size == 0) gl.BindBufferBase(bindings.target, GLuint(i), range.buffer);
        else
            gl.BindBufferRange(bindings.target, GLuint(i), range.buffer, GLintptr(range.start),
                               GLsizeiptr(range.size));
    }
    // Last, since indexed bindings change it as well.
    gl.BindBuffer(bindings.target, bindings.generic);
}

} // namespace rebound::opengl
