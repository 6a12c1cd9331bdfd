// SPDX-License-Identifier: MIT
#include "lab/host/opengl_texture.hpp"

#include "lab/host/gl_functions.hpp"

#include <array>
#include <string>
#include <utility>

namespace rebound::host {
namespace {

GLenum internalFormat(Format f) {
    constexpr std::array<GLenum, 5> formats{GL_R32F, GL_RGBA16F, GL_RGBA32F, GL_R32UI, GL_RGBA32UI};
    return formats[size_t(f)];
}

// Four channels, whatever the image has.
std::vector<float> withFourChannels(const lab::Image& image) {
    std::vector<float> texels;
    texels.reserve(size_t(image.width) * size_t(image.height) * 4);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 4; ++c)
                texels.push_back(c < image.channels ? image.at(x, y)[c] : c == 3 ? 1.0f : 0.0f);
    return texels;
}

} // namespace

OpenGLTexture::OpenGLTexture(Format format, Extent2D e) : size(e) {
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, internalFormat(format), e.width, e.height);
    glBindTexture(GL_TEXTURE_2D, 0);
}

OpenGLTexture::OpenGLTexture(Format format, const lab::Image& image) : OpenGLTexture(format, image.extent()) {
    writeTexture(texture, format, image);
}

OpenGLTexture::OpenGLTexture(OpenGLTexture&& other) noexcept
    : texture(std::exchange(other.texture, 0)), size(other.size) {}

OpenGLTexture& OpenGLTexture::operator=(OpenGLTexture&& other) noexcept {
    std::swap(texture, other.texture);
    std::swap(size, other.size);
    return *this;
}

OpenGLTexture::~OpenGLTexture() {
    if (texture != 0) glDeleteTextures(1, &texture);
}

void writeTexture(unsigned texture, Format format, const lab::Image& image) {
    std::vector<float> texels = withFourChannels(image);
    GLenum layout = isInteger(format) ? GL_RGBA_INTEGER : GL_RGBA;
    if (format == Format::r32f || format == Format::r32ui) {
        layout = isInteger(format) ? GL_RED_INTEGER : GL_RED;
        for (size_t i = 0; i < texels.size() / 4; ++i) texels[i] = texels[4 * i];
    }
    GLint before = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, layout,
                    isInteger(format) ? GL_UNSIGNED_INT : GL_FLOAT, texels.data());
    glBindTexture(GL_TEXTURE_2D, GLuint(before));
}

Result<lab::Image> readTexture(unsigned texture, Extent2D extent, int channels, bool ofIntegers) {
    if (channels < 1 || channels > 4)
        return invalidArgument("channels is " + std::to_string(channels) + "; 1 to 4 was expected");
    GLuint framebuffer = 0;
    GLint before = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    const bool complete = glCheckFramebufferStatus(GL_READ_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    std::vector<float> texels(size_t(extent.width) * size_t(extent.height) * 4);
    if (complete)
        glReadPixels(0, 0, extent.width, extent.height, ofIntegers ? GL_RGBA_INTEGER : GL_RGBA,
                     ofIntegers ? GL_UNSIGNED_INT : GL_FLOAT, texels.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(before));
    glDeleteFramebuffers(1, &framebuffer);
    if (!complete)
        return Error{ErrorCode::unsupported,
                     "texture " + std::to_string(texture) + " cannot be read back: it cannot be drawn to"};
    lab::Image image(extent, channels);
    for (size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = texels[i / size_t(channels) * 4 + i % size_t(channels)];
    return image;
}

} // namespace rebound::host
