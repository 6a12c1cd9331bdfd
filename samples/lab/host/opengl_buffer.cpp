// SPDX-License-Identifier: MIT
#include "lab/host/opengl_buffer.hpp"

#include "lab/host/gl_functions.hpp"

#include <cstring>
#include <string>
#include <utility>

namespace rebound::host {
namespace {

// Nothing of a frame is bound there.
constexpr GLenum target = GL_COPY_WRITE_BUFFER;

} // namespace

OpenGLBuffer::OpenGLBuffer(size_t size) {
    const std::vector<std::byte> zeros(size);
    glGenBuffers(1, &buffer);
    glBindBuffer(target, buffer);
    glBufferData(target, GLsizeiptr(size), zeros.data(), GL_DYNAMIC_COPY);
    glBindBuffer(target, 0);
}

OpenGLBuffer::OpenGLBuffer(OpenGLBuffer&& other) noexcept : buffer(std::exchange(other.buffer, 0)) {}

OpenGLBuffer& OpenGLBuffer::operator=(OpenGLBuffer&& other) noexcept {
    std::swap(buffer, other.buffer);
    return *this;
}

OpenGLBuffer::~OpenGLBuffer() {
    if (buffer != 0) glDeleteBuffers(1, &buffer);
}

Result<std::vector<std::byte>> readBuffer(unsigned buffer, size_t offset, size_t size) {
    std::vector<std::byte> bytes(size);
    glBindBuffer(target, buffer);
    const void* mapped = glMapBufferRange(target, GLintptr(offset), GLsizeiptr(size), GL_MAP_READ_BIT);
    if (mapped) std::memcpy(bytes.data(), mapped, size);
    const bool intact = mapped && glUnmapBuffer(target);
    glBindBuffer(target, 0);
    if (!intact)
        return Error{ErrorCode::unsupported, "buffer " + std::to_string(buffer) + " cannot be read back"};
    return bytes;
}

void writeBuffer(unsigned buffer, size_t offset, std::span<const std::byte> bytes) {
    glBindBuffer(target, buffer);
    glBufferSubData(target, GLintptr(offset), GLsizeiptr(bytes.size()), bytes.data());
    glBindBuffer(target, 0);
}

} // namespace rebound::host
