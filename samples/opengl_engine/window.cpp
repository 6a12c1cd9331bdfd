// SPDX-License-Identifier: MIT
#include "window.hpp"

#include "renderer.hpp"

#include "lab/engine/orbit.hpp"
#include "lab/host/opengl_context.hpp"
#include "lab/images/image_files.hpp"

#include "present_frag.h"
#include "present_vert.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace rebound::engine {
namespace {

void APIENTRY collect(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar* text,
                      const void* user) {
    if (severity != GL_DEBUG_SEVERITY_NOTIFICATION)
        static_cast<std::vector<std::string>*>(const_cast<void*>(user))->emplace_back(text);
}

// Ends GLFW, and the window with it, behind all that lives in its context.
struct Glfw {
    bool ready = glfwInit() == GLFW_TRUE;
    ~Glfw() { glfwTerminate(); }
};

GLFWwindow* openWindow(const Options& o) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, o.validation ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    return glfwCreateWindow(o.size.width, o.size.height, "Rebound", nullptr, nullptr);
}

// Renders one frame aside, for an exposure that stays.
Result<float> exposureOf(Renderer& renderer, const lab::CameraView& view) {
    if (auto rendered = renderer.render(view); !rendered) return rendered.error();
    auto composed = renderer.read(renderer.targets().composed, 3);
    if (!composed) return composed.error();
    return lab::automaticToneCurve(*composed).exposure;
}

void present(const Renderer& renderer, GLuint program, GLuint vertexArray, float exposure) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glUseProgram(program);
    glUniform1f(0, exposure);
    glBindTexture(GL_TEXTURE_2D, renderer.targets().composed.name());
    glBindVertexArray(vertexArray);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_FRAMEBUFFER_SRGB);
}

Result<> showFrames(const Options& o, GLFWwindow* window, const lab::Scene& scene, Orbit& orbit) {
    const auto loader = [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); };
    auto renderer = createRenderer(loader, scene, o);
    if (!renderer) return renderer.error();
    if (auto sized = (*renderer)->resize(o.size, orbit.view); !sized) return sized;
    const auto exposure = exposureOf(**renderer, orbit.view);
    if (!exposure) return exposure.error();
    auto program =
        makeProgram("present", {{GL_VERTEX_SHADER, present_vert}, {GL_FRAGMENT_SHADER, present_frag}});
    if (!program) return program.error();
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    const VertexArray vertexArray(name); // without attributes

    for (int shown = 0; !glfwWindowShouldClose(window) && (!o.frames || shown < *o.frames);) {
        glfwPollEvents();
        Extent2D size;
        glfwGetFramebufferSize(window, &size.width, &size.height);
        if (size.width == 0 || size.height == 0) { // minimised
            glfwWaitEvents();
            continue;
        }
        if (size != (*renderer)->targets().extent)
            if (auto sized = (*renderer)->resize(size, orbit.view); !sized) return sized;
        if (!o.bake.empty()) (*renderer)->set(momentOf(scene, shown));
        if (auto rendered = (*renderer)->render(orbit.view); !rendered) return rendered;
        glViewport(0, 0, size.width, size.height);
        present(**renderer, program->name(), vertexArray.name(), *exposure);
        glfwSwapBuffers(window);
        ++shown;
    }
    return checkErrors("while frames were shown");
}

} // namespace

Result<> showWindow(const Options& o, const lab::Scene& scene, const lab::CameraView& start) {
    const Glfw glfw;
    GLFWwindow* window = glfw.ready ? openWindow(o) : nullptr;
    if (!window) return windowError("no window with OpenGL 4.3 can be opened here");
    glfwMakeContextCurrent(window);
    const GLubyte* text = glGetString(GL_RENDERER);
    const std::string device = text ? reinterpret_cast<const char*>(text) : "";
    if (auto found = host::requireDevice(device, o.device); !found) return found;
    std::vector<std::string> messages;
    if (o.validation) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(collect, &messages);
    }
    Orbit orbit{start};
    orbit.listen(window);
    if (auto shown = showFrames(o, window, scene, orbit); !shown) return shown;
    if (!messages.empty()) return Error{ErrorCode::invalidData, "validation: " + messages.front()};
    return {};
}

} // namespace rebound::engine
