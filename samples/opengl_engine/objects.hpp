// SPDX-License-Identifier: MIT
// OpenGL objects that delete themselves: their context has to be current then.
#pragma once

#include "lab/host/gl_functions.hpp"
#include "rebound/result.hpp"

#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>

namespace rebound::engine {

template <auto destroy>
class Object {
public:
    Object() = default;
    explicit Object(GLuint n) : owned(n) {}
    Object(Object&& other) noexcept : owned(std::exchange(other.owned, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(owned, other.owned);
        return *this;
    }
    ~Object() {
        if (owned != 0) destroy(owned);
    }
    GLuint name() const { return owned; }

private:
    GLuint owned = 0;
};

inline void deleteTexture(GLuint name) { glDeleteTextures(1, &name); }
inline void deleteBuffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void deleteFramebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void deleteVertexArray(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void deleteShader(GLuint name) { glDeleteShader(name); }
inline void deleteProgram(GLuint name) { glDeleteProgram(name); }

using Texture = Object<deleteTexture>;
using Buffer = Object<deleteBuffer>;
using Framebuffer = Object<deleteFramebuffer>;
using VertexArray = Object<deleteVertexArray>;
using Shader = Object<deleteShader>;
using Program = Object<deleteProgram>;

struct Stage {
    GLenum kind;
    const char* source;
};
// Fails with the driver's words.
Result<Program> makeProgram(const char* name, std::initializer_list<Stage>);

// Holding these bytes. Leaves it bound to that target.
Buffer makeBuffer(GLenum target, std::span<const std::byte>);
Texture makeDepthTexture(GLsizei width, GLsizei height);
// Leaves it bound.
Framebuffer makeFramebuffer(GLuint depth, std::initializer_list<GLuint> colors);

// Fails where an error is pending, and clears it; the message says what it came from.
Result<> checkErrors(const char* what);

} // namespace rebound::engine
