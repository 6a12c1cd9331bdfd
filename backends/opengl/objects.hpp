// SPDX-License-Identifier: MIT
// An object of OpenGL that is deleted with its owner.
#pragma once

#include "gl.hpp"

#include <utility>

namespace rebound::opengl {

enum class ObjectKind { texture, buffer, sampler, program, query };

class Object {
public:
    Object() = default;
    Object(std::shared_ptr<const Gl> functions, ObjectKind objectKind)
        : gl(std::move(functions)), kind(objectKind) {
        switch (kind) {
        case ObjectKind::texture:
            gl->GenTextures(1, &object);
            break;
        case ObjectKind::buffer:
            gl->GenBuffers(1, &object);
            break;
        case ObjectKind::sampler:
            gl->GenSamplers(1, &object);
            break;
        case ObjectKind::program:
            object = gl->CreateProgram();
            break;
        case ObjectKind::query:
            gl->GenQueries(1, &object);
            break;
        }
    }
    Object(Object&& other) noexcept
        : gl(std::move(other.gl)), kind(other.kind), object(std::exchange(other.object, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(gl, other.gl);
        std::swap(kind, other.kind);
        std::swap(object, other.object);
        return *this;
    }
    ~Object() {
        if (object == 0) return;
        switch (kind) {
        case ObjectKind::texture:
            gl->DeleteTextures(1, &object);
            break;
        case ObjectKind::buffer:
            gl->DeleteBuffers(1, &object);
            break;
        case ObjectKind::sampler:
            gl->DeleteSamplers(1, &object);
            break;
        case ObjectKind::program:
            gl->DeleteProgram(object);
            break;
        case ObjectKind::query:
            gl->DeleteQueries(1, &object);
            break;
        }
    }

    GLuint name() const { return object; }

private:
    std::shared_ptr<const Gl> gl;
    ObjectKind kind = ObjectKind::texture;
    GLuint object = 0;
};

} // namespace rebound::opengl
