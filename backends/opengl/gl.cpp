// SPDX-License-Identifier: MIT
#include "gl.hpp"

#include <algorithm>
#include <cstdio>

namespace rebound::opengl {
namespace {

constexpr const char* creating = "creating a device";

template <class Function>
void find(const Loader& loader, Function& function, const std::string& name) {
    function = reinterpret_cast<Function>(loader(name.c_str()));
}

Error missingFunction(const std::string& name) {
    return {ErrorCode::unsupported,
            "options.loader gives no " + name + ", which OpenGL 4.3 and OpenGL ES 3.1 have"};
}

// "4.6.0 NVIDIA 535.54" or "OpenGL ES 3.2 Mesa 22.3.6".
Result<> readVersion(Gl& gl) {
    const char* text = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
    if (!text && gl.GetError && gl.GetError() == GL_CONTEXT_LOST) return gl.lost(creating, GL_CONTEXT_LOST);
    if (!text)
        return invalidArgument(
            "no OpenGL context is current; one of OpenGL 4.3 or OpenGL ES 3.1 was expected");
    std::string_view rest = text;
    constexpr std::string_view es = "OpenGL ES ";
    gl.es = rest.starts_with(es);
    if (gl.es) rest.remove_prefix(es.size());
    int major = 0, minor = 0;
    if (std::sscanf(std::string(rest).c_str(), "%d.%d", &major, &minor) != 2)
        return Error{ErrorCode::unsupported, std::string("the context's version is \"") + text +
                                                 "\"; OpenGL 4.3 or OpenGL ES 3.1 was expected"};
    gl.version = 10 * major + minor;
    if (gl.version < (gl.es ? 31 : 43))
        return Error{ErrorCode::unsupported,
                     std::string("the context is of ") + (gl.es ? "OpenGL ES " : "OpenGL ") +
                         std::to_string(major) + "." + std::to_string(minor) +
                         "; OpenGL 4.3 or OpenGL ES 3.1, which have compute shaders, " + "was expected"};
    return {};
}

Result<> findFunctions(Gl& gl, const Loader& loader) {
#define REBOUND_GL_FIND(type, name)                                                                          \
    find(loader, gl.name, "gl" #name);                                                                       \
    if (!gl.name) return missingFunction("gl" #name);
    REBOUND_GL_FUNCTIONS(REBOUND_GL_FIND)
#undef REBOUND_GL_FIND
    return {};
}

bool hasExtension(const Gl& gl, std::string_view wanted) {
    const int count = gl.integer(GL_NUM_EXTENSIONS);
    for (int i = 0; i < count; ++i) {
        const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, GLuint(i));
        if (name && wanted == reinterpret_cast<const char*>(name)) return true;
    }
    return false;
}

// Part of OpenGL 4.3 and OpenGL ES 3.2; before, an extension whose functions have a suffix.
void findDebug(Gl& gl, const Loader& loader) {
    const bool core = !gl.es || gl.version >= 32;
    if (!core && !hasExtension(gl, "GL_KHR_debug")) return;
    const std::string suffix = core ? "" : "KHR";
    find(loader, gl.PushDebugGroup, "glPushDebugGroup" + suffix);
    find(loader, gl.PopDebugGroup, "glPopDebugGroup" + suffix);
    find(loader, gl.ObjectLabel, "glObjectLabel" + suffix);
    if (!gl.PopDebugGroup) gl.PushDebugGroup = nullptr;
    gl.limits.debugGroups = gl.integer(GL_MAX_DEBUG_GROUP_STACK_DEPTH);
    gl.limits.labelLength =
        std::min(gl.integer(GL_MAX_LABEL_LENGTH), gl.integer(GL_MAX_DEBUG_MESSAGE_LENGTH)) - 1;
}

void findTimestamps(Gl& gl, const Loader& loader) {
    if (gl.es && !hasExtension(gl, "GL_EXT_disjoint_timer_query")) return;
    const std::string suffix = gl.es ? "EXT" : "";
    PFNGLGETQUERYIVPROC getQueryiv = nullptr;
    find(loader, getQueryiv, "glGetQueryiv" + suffix);
    GLint bits = 0;
    if (getQueryiv) getQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0) return; // the context says that it has none
    find(loader, gl.QueryCounter, "glQueryCounter" + suffix);
    find(loader, gl.GetQueryObjectui64v, "glGetQueryObjectui64v" + suffix);
    if (!gl.GetQueryObjectui64v) gl.QueryCounter = nullptr;
}

// Part of OpenGL 4.5 and OpenGL ES 3.2; before, of several extensions.
void findResetStatus(Gl& gl, const Loader& loader) {
    const std::string name = "glGetGraphicsResetStatus";
    if (gl.version >= (gl.es ? 32 : 45)) find(loader, gl.GetGraphicsResetStatus, name);
    else if (hasExtension(gl, "GL_KHR_robustness"))
        find(loader, gl.GetGraphicsResetStatus, name + (gl.es ? "KHR" : ""));
    else if (hasExtension(gl, gl.es ? "GL_EXT_robustness" : "GL_ARB_robustness"))
        find(loader, gl.GetGraphicsResetStatus, name + (gl.es ? "EXT" : "ARB"));
}

void readLimits(Gl& gl) {
    Limits& l = gl.limits;
    l.textureSize = gl.integer(GL_MAX_TEXTURE_SIZE);
    l.textures = gl.integer(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS);
    l.images = std::min(gl.integer(GL_MAX_COMPUTE_IMAGE_UNIFORMS), gl.integer(GL_MAX_IMAGE_UNITS));
    l.uniformBlocks = gl.integer(GL_MAX_COMPUTE_UNIFORM_BLOCKS);
    l.storageBlocks = gl.integer(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
    GLint64 size = 0;
    gl.GetInteger64v(GL_MAX_UNIFORM_BLOCK_SIZE, &size);
    l.uniformBlock = size;
    gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &size);
    l.storageBlock = size;
    l.storageAlignment = gl.integer(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
    // Both are powers of two: the larger one serves either use.
    l.alignment = size_t(std::max({gl.integer(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT),
                                   gl.integer(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT), 16}));
}

} // namespace

Result<std::shared_ptr<const Gl>> Gl::load(const Loader& loader) {
    if (!loader)
        return invalidArgument(
            "options.loader is empty; a function that finds OpenGL's functions was expected");
    auto gl = std::make_shared<Gl>();
    find(loader, gl->GetString, "glGetString");
    if (!gl->GetString) return missingFunction("glGetString");
    find(loader, gl->GetError, "glGetError");
    // Before all other functions: a context that is too old lacks some.
    if (auto version = readVersion(*gl); !version) return version.error();
    if (auto found = findFunctions(*gl, loader); !found) return found.error();
    readLimits(*gl);
    findDebug(*gl, loader);
    findTimestamps(*gl, loader);
    findResetStatus(*gl, loader);
    // A context that was lost meanwhile has told nothing but zeros.
    if (auto present = gl->checkPresent(creating); !present) return present.error();
    return std::shared_ptr<const Gl>(std::move(gl));
}

Result<> Gl::checkPresent(const char* doing) const {
    if (auto present = loss.check(); !present) return present;
    const GLenum status = GetGraphicsResetStatus ? GetGraphicsResetStatus() : GLenum(GL_NO_ERROR);
    if (status != GL_NO_ERROR) return lost(doing, status);
    return {};
}

Error Gl::lost(const char* doing, GLenum how) const {
    return loss.note(std::string(doing) + " failed with " + errorName(how) +
                     ": the OpenGL context is lost, and what was made in it can only be destroyed");
}

void Gl::label(GLenum kind, GLuint object, std::string_view text) const {
    if (ObjectLabel)
        ObjectLabel(kind, object, std::min(GLsizei(text.size()), limits.labelLength), text.data());
}

std::string errorName(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_STACK_OVERFLOW:
        return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW:
        return "GL_STACK_UNDERFLOW";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    case GL_GUILTY_CONTEXT_RESET:
        return "GL_GUILTY_CONTEXT_RESET";
    case GL_INNOCENT_CONTEXT_RESET:
        return "GL_INNOCENT_CONTEXT_RESET";
    case GL_UNKNOWN_CONTEXT_RESET:
        return "GL_UNKNOWN_CONTEXT_RESET";
    default:
        return "the error " + std::to_string(error);
    }
}

} // namespace rebound::opengl
