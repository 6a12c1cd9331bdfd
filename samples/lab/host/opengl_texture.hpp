// SPDX-License-Identifier: MIT
// Textures of a host, from images of the lab and back.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/plan.hpp"
#include "rebound/result.hpp"

namespace rebound::host {

// A GL_TEXTURE_2D of one level that its owner deletes: the context it was made in must be current then.
class OpenGLTexture {
public:
    OpenGLTexture() = default;
    OpenGLTexture(Format, Extent2D);
    // As writeTexture() has it.
    OpenGLTexture(Format, const lab::Image&);
    OpenGLTexture(OpenGLTexture&&) noexcept;
    OpenGLTexture& operator=(OpenGLTexture&&) noexcept;
    ~OpenGLTexture();

    unsigned name() const { return texture; }
    Extent2D extent() const { return size; }

private:
    unsigned texture = 0;
    Extent2D size;
};

// Replaces all of a texture of that format; row 0 of the image becomes row 0 of the texture. Channels that the image lacks
// are 0, alpha 1. Unsigned integers are given as floats of the same bits.
void writeTexture(unsigned texture, Format, const lab::Image&);

// The first channels of a texture that can be drawn to; row 0 of the texture becomes row 0 of the image.
// Unsigned integers become floats of the same bits.
Result<lab::Image> readTexture(unsigned texture, Extent2D, int channels, bool ofIntegers = false);

} // namespace rebound::host
