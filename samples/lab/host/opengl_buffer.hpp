// SPDX-License-Identifier: MIT
// Buffer objects of a host.
#pragma once

#include "rebound/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rebound::host {

// A buffer object that its owner deletes: the context it was made in must be current then. It begins as zeros.
class OpenGLBuffer {
public:
    OpenGLBuffer() = default;
    explicit OpenGLBuffer(size_t size);
    OpenGLBuffer(OpenGLBuffer&&) noexcept;
    OpenGLBuffer& operator=(OpenGLBuffer&&) noexcept;
    ~OpenGLBuffer();

    unsigned name() const { return buffer; }

private:
    unsigned buffer = 0;
};

// Bytes of a buffer object, from an offset on.
Result<std::vector<std::byte>> readBuffer(unsigned buffer, size_t offset, size_t size);
void writeBuffer(unsigned buffer, size_t offset, std::span<const std::byte>);

} // namespace rebound::host
