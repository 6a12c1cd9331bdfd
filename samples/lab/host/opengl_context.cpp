// SPDX-License-Identifier: MIT
#include "lab/host/opengl_context.hpp"

#include "lab/host/gl_functions.hpp"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string_view>
#include <utility>

namespace rebound::host {

Result<> requireDevice(const std::string& description, const std::string& part) {
    if (description.find(part) != std::string::npos) return {};
    return Error{ErrorCode::notFound,
                 "no device whose name holds \"" + part + "\" was found; there is " + description};
}

struct OpenGLContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::vector<std::string> messages;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (context == EGL_NO_CONTEXT) return;
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        // The display stays: EGL hands out the same one to everybody, and other contexts may live on it.
        eglDestroyContext(display, context);
    }
};

namespace {

template <class Function>
Function eglFunction(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool lists(const char* extensions, std::string_view name) {
    const std::string_view all = extensions ? extensions : "";
    for (size_t at = all.find(name); at != all.npos; at = all.find(name, at + 1))
        if (at + name.size() == all.size() || all[at + name.size()] == ' ') return true;
    return false;
}

bool isUsable(EGLDisplay display) {
    return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr);
}

// Mesa's display without a window, or else the first device that has one.
EGLDisplay findDisplay() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto displayOf = eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (!displayOf) return EGL_NO_DISPLAY;
    if (lists(extensions, "EGL_MESA_platform_surfaceless")) {
        const EGLDisplay display = displayOf(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (isUsable(display)) return display;
    }
    const auto queryDevices = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    if (!queryDevices || !lists(extensions, "EGL_EXT_platform_device")) return EGL_NO_DISPLAY;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    queryDevices(EGLint(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i)
        if (const EGLDisplay display = displayOf(EGL_PLATFORM_DEVICE_EXT, devices[size_t(i)], nullptr);
            isUsable(display))
            return display;
    return EGL_NO_DISPLAY;
}

Error eglError(const std::string& what) {
    constexpr const char* digits = "0123456789ABCDEF";
    const EGLint code = eglGetError();
    std::string text = "0x";
    for (int shift = 12; shift >= 0; shift -= 4) text += digits[code >> shift & 15];
    return {ErrorCode::unsupported, what + ": EGL error " + text};
}

void APIENTRY collect(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar* text,
                      const void* user) {
    if (severity != GL_DEBUG_SEVERITY_NOTIFICATION)
        static_cast<std::vector<std::string>*>(const_cast<void*>(user))->emplace_back(text);
}

// Part of OpenGL 4.3 and OpenGL ES 3.2; before, an extension whose functions have a suffix.
void collectMessages(std::vector<std::string>& messages) {
    auto callback = eglFunction<PFNGLDEBUGMESSAGECALLBACKPROC>("glDebugMessageCallback");
    if (!callback) callback = eglFunction<PFNGLDEBUGMESSAGECALLBACKPROC>("glDebugMessageCallbackKHR");
    if (!callback) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    callback(collect, &messages);
}

} // namespace

OpenGLContext::OpenGLContext(std::unique_ptr<State> s) : state(std::move(s)) {}
OpenGLContext::OpenGLContext(OpenGLContext&&) noexcept = default;
OpenGLContext& OpenGLContext::operator=(OpenGLContext&&) noexcept = default;
OpenGLContext::~OpenGLContext() = default;

Result<OpenGLContext> OpenGLContext::create(OpenGLApi api) {
    auto state = std::make_unique<State>();
    state->display = findDisplay();
    if (state->display == EGL_NO_DISPLAY)
        return Error{ErrorCode::unsupported, "EGL has no display that works without a window"};
    const char* extensions = eglQueryString(state->display, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"})
        if (!lists(extensions, needed))
            return Error{ErrorCode::unsupported, "EGL's display lacks " + std::string(needed)};
    const bool es = api == OpenGLApi::es;
    eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION, es ? 3 : 4,
                                      EGL_CONTEXT_MINOR_VERSION, es ? 1 : 3,
                                      EGL_CONTEXT_OPENGL_DEBUG,  EGL_TRUE};
    if (!es)
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT});
    attributes.push_back(EGL_NONE);
    state->context = eglCreateContext(state->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (state->context == EGL_NO_CONTEXT)
        return eglError(es ? "no context of OpenGL ES 3.1" : "no context of OpenGL 4.3");
    OpenGLContext context(std::move(state));
    if (auto current = context.makeCurrent(); !current) return current.error();
    collectMessages(context.state->messages);
    return context;
}

Result<> OpenGLContext::makeCurrent() const {
    if (!eglMakeCurrent(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context))
        return eglError("the context could not be made current");
    return {};
}

void OpenGLContext::makeNoneCurrent() {
    if (const EGLDisplay display = eglGetCurrentDisplay(); display != EGL_NO_DISPLAY)
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

void* OpenGLContext::functionNamed(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

std::string OpenGLContext::description() const {
    const auto text = [](GLenum name) {
        const GLubyte* value = glGetString(name);
        return std::string(value ? reinterpret_cast<const char*>(value) : "");
    };
    return text(GL_VERSION) + ", " + text(GL_RENDERER);
}

std::vector<std::string> OpenGLContext::takeMessages() { return std::exchange(state->messages, {}); }

} // namespace rebound::host
