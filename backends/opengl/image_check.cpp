// SPDX-License-Identifier: MIT
#include "image_check.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

namespace rebound::opengl {
namespace {

int levelParameter(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetTexLevelParameteriv(GL_TEXTURE_2D, 0, name, &value);
    return value;
}

int textureParameter(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetTexParameteriv(GL_TEXTURE_2D, name, &value);
    return value;
}

std::string hexadecimal(int value) {
    std::string text;
    for (int shift = 12; shift >= 0; shift -= 4) text += "0123456789ABCDEF"[value >> shift & 15];
    return "0x" + text;
}

// Binds the texture and says whether that was possible: it is not where the texture has another target.
bool bindTexture(const Gl& gl, GLuint texture) {
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    if (GLuint(gl.integer(GL_TEXTURE_BINDING_2D)) == texture) return true;
    gl.GetError(); // the one that this has caused; it is reported by name
    return false;
}

int channelCount(const Gl& gl) {
    int count = 0;
    for (GLenum size : std::initializer_list<GLenum>{GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE,
                                                     GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE})
        count += levelParameter(gl, size) > 0 ? 1 : 0;
    return count > 0 ? count : levelParameter(gl, GL_TEXTURE_DEPTH_SIZE) > 0 ? 1 : 0;
}

Result<> checkInput(const Gl& gl, const Resource& r, const std::string& what) {
    if (const int base = textureParameter(gl, GL_TEXTURE_BASE_LEVEL); base != 0)
        return invalidArgument(what + " has the base level " + std::to_string(base) + "; 0 was expected");
    const int format = levelParameter(gl, GL_TEXTURE_INTERNAL_FORMAT),
              type = levelParameter(gl, GL_TEXTURE_RED_TYPE);
    const bool isStencil = (format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8) &&
                           textureParameter(gl, GL_DEPTH_STENCIL_TEXTURE_MODE) == GL_STENCIL_INDEX;
    const bool isUnsigned = type == GL_UNSIGNED_INT || isStencil;
    if (isInteger(r.format) && !isUnsigned)
        return invalidArgument(what + ", of internal format " + hexadecimal(format) +
                               ", holds no unsigned integers; a format that samples as such was expected");
    if (!isInteger(r.format) && (type == GL_INT || isUnsigned))
        return invalidArgument(what + ", of internal format " + hexadecimal(format) +
                               ", holds integers; a format that samples as floats was expected");
    if (const int channels = channelCount(gl); channels < r.channels)
        return invalidArgument(what + " has " + std::to_string(channels) + " channels; " +
                               std::to_string(r.channels) + " to 4 were expected");
    return {};
}

Result<> checkOutput(const Gl& gl, Format format, const std::string& what) {
    const int actual = levelParameter(gl, GL_TEXTURE_INTERNAL_FORMAT), expected = int(internalFormat(format));
    if (actual != expected)
        return invalidArgument(what + " has the internal format " + hexadecimal(actual) + "; " +
                               name(format) + " (" + hexadecimal(expected) + ") was expected");
    if (gl.es && !textureParameter(gl, GL_TEXTURE_IMMUTABLE_FORMAT))
        return invalidArgument(what +
                               " is mutable; OpenGL ES writes to textures made by glTexStorage2D only");
    return {};
}

Result<> checkAlone(const Plan& plan, size_t output, const std::vector<const Image*>& images) {
    for (size_t i = 0; i < images.size(); ++i)
        if (i != output && images[i] && images[i]->texture == images[output]->texture)
            return invalidArgument("inputs.images: " + plan.resources[output].name + " and " +
                                   plan.resources[i].name + " are both texture " +
                                   std::to_string(images[i]->texture) +
                                   "; an output of its own was expected");
    return {};
}

Result<> checkImage(const Gl& gl, const Resource& r, GLuint texture, Format outputFormat) {
    const std::string what = "inputs.images: " + r.name;
    if (texture == 0) return invalidArgument(what + " is texture 0; a GL_TEXTURE_2D was expected");
    const std::string named = what + ", texture " + std::to_string(texture) + ",";
    if (!gl.IsTexture(texture)) return invalidArgument(named + " does not exist or has been deleted");
    if (!bindTexture(gl, texture)) return invalidArgument(named + " is no GL_TEXTURE_2D");
    const Extent2D extent{levelParameter(gl, GL_TEXTURE_WIDTH), levelParameter(gl, GL_TEXTURE_HEIGHT)};
    if (extent != r.extent)
        return invalidArgument(what + " is " + detail::toText(extent) + "; " + detail::toText(r.extent) +
                               " was expected");
    return r.kind == ResourceKind::input ? checkInput(gl, r, what) : checkOutput(gl, outputFormat, what);
}

} // namespace

GLenum internalFormat(Format f) {
    switch (f) {
    case Format::r32f:
        return GL_R32F;
    case Format::rgba16f:
        return GL_RGBA16F;
    case Format::rgba32f:
        return GL_RGBA32F;
    case Format::r32ui:
        return GL_R32UI;
    case Format::rgba32ui:
        return GL_RGBA32UI;
    }
    return GL_NONE;
}

Result<> checkBuffers(const Gl& gl, const Plan& plan, const std::vector<const Buffer*>& buffers) {
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        if (!buffers[i]) continue;
        const Buffer& b = *buffers[i];
        const Resource& r = plan.resources[i];
        const std::string what = "inputs.buffers: " + r.name;
        if (b.buffer == 0 || !gl.IsBuffer(b.buffer))
            return invalidArgument(what + " is buffer " + std::to_string(b.buffer) +
                                   ", which does not exist or has been deleted");
        if (int64_t(b.offset) % gl.limits.storageAlignment != 0)
            return invalidArgument(what + " has the offset " + std::to_string(b.offset) + "; a multiple of " +
                                   std::to_string(gl.limits.storageAlignment) + " was expected");
        if (b.size < r.size) return detail::smallBuffer(r, b.size);
        GLint64 held = 0;
        gl.BindBuffer(GL_UNIFORM_BUFFER, b.buffer);
        gl.GetBufferParameteri64v(GL_UNIFORM_BUFFER, GL_BUFFER_SIZE, &held);
        if (size_t(held) < b.offset + r.size)
            return detail::smallBuffer(r, size_t(held) - std::min(size_t(held), b.offset));
        for (size_t j = 0; j < plan.resources.size(); ++j)
            if (r.kind == ResourceKind::outputBuffer && j != i && buffers[j] &&
                buffers[j]->buffer == b.buffer)
                return invalidArgument(what + " and " + plan.resources[j].name + " are both buffer " +
                                       std::to_string(b.buffer) +
                                       "; an output buffer of its own was expected");
    }
    return {};
}

Result<> checkImages(const Gl& gl, const Plan& plan, const std::vector<const Image*>& images,
                     const std::vector<Format>& formats) {
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        if (!images[i]) continue;
        const Resource& r = plan.resources[i];
        if (auto valid = checkImage(gl, r, images[i]->texture, formats[i]); !valid) return valid.error();
        if (r.kind != ResourceKind::output) continue;
        if (auto alone = checkAlone(plan, i, images); !alone) return alone.error();
    }
    return {};
}

} // namespace rebound::opengl
