// SPDX-License-Identifier: MIT
#include "objects.hpp"

#include <string>
#include <vector>

namespace rebound::engine {
namespace {

template <class GetStatus, class GetLog>
Result<> checkLog(GLuint object, GLenum status, GetStatus getStatus, GetLog getLog, const char* name) {
    GLint fine = GL_FALSE, length = 0;
    getStatus(object, status, &fine);
    if (fine == GL_TRUE) return {};
    getStatus(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(length) + 1, '\0');
    getLog(object, length, nullptr, log.data());
    return Error{ErrorCode::unsupported,
                 std::string("the driver refuses the shader ") + name + ": " + log.c_str()};
}

} // namespace

Result<Program> makeProgram(const char* name, std::initializer_list<Stage> stages) {
    Program program(glCreateProgram());
    for (const Stage& stage : stages) {
        const Shader shader(glCreateShader(stage.kind));
        glShaderSource(shader.name(), 1, &stage.source, nullptr);
        glCompileShader(shader.name());
        if (auto made = checkLog(shader.name(), GL_COMPILE_STATUS, glGetShaderiv, glGetShaderInfoLog, name);
            !made)
            return made.error();
        glAttachShader(program.name(), shader.name());
    }
    glLinkProgram(program.name());
    if (auto made = checkLog(program.name(), GL_LINK_STATUS, glGetProgramiv, glGetProgramInfoLog, name);
        !made)
        return made.error();
    return program;
}

Buffer makeBuffer(GLenum target, std::span<const std::byte> bytes) {
    GLuint name = 0;
    glGenBuffers(1, &name);
    glBindBuffer(target, name);
    glBufferData(target, GLsizeiptr(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    return Buffer(name);
}

Texture makeDepthTexture(GLsizei width, GLsizei height) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, width, height);
    // Depth is fetched, never filtered.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
    return Texture(name);
}

Framebuffer makeFramebuffer(GLuint depth, std::initializer_list<GLuint> colors) {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    std::vector<GLenum> buffers;
    for (GLuint color : colors) {
        buffers.push_back(GLenum(GL_COLOR_ATTACHMENT0 + buffers.size()));
        glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, color, 0);
    }
    glDrawBuffers(GLsizei(buffers.size()), buffers.data());
    return Framebuffer(name);
}

Result<> checkErrors(const char* what) {
    const GLenum first = glGetError();
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
    } // a lost context reports errors without end
    if (first == GL_NO_ERROR) return {};
    if (first == GL_OUT_OF_MEMORY)
        return Error{ErrorCode::outOfMemory, std::string("OpenGL is out of memory ") + what};
    return Error{ErrorCode::unsupported, "OpenGL error " + std::to_string(first) + " " + what};
}

} // namespace rebound::engine
