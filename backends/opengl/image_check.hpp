// SPDX-License-Identifier: MIT
// Whether the host's textures and buffers are what a plan expects.
#pragma once

#include "gl.hpp"

#include <vector>

namespace rebound::opengl {

GLenum internalFormat(Format);

// images: by resource, null for those that are not the host's. formats: by resource, of outputs: as kernels
// declare them. Binds to the active texture unit, and changes nothing else.
Result<> checkImages(const Gl&, const Plan&, const std::vector<const Image*>& images,
                     const std::vector<Format>& formats);

// buffers: likewise. Binds to GL_UNIFORM_BUFFER, and changes nothing else.
Result<> checkBuffers(const Gl&, const Plan&, const std::vector<const Buffer*>& buffers);

} // namespace rebound::opengl
