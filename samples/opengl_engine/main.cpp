// SPDX-License-Identifier: MIT
#include "renderer.hpp"
#ifdef REBOUND_HAS_WINDOW
#include "window.hpp"
#endif

#include "lab/engine/command_line.hpp"
#include "lab/host/opengl_context.hpp"

namespace rebound::engine {
namespace {

using host::OpenGLContext;

Result<> renderToFile(const Options& o, const std::string& device, const lab::Scene& scene,
                      const lab::CameraView& camera) {
    auto renderer = createRenderer(OpenGLContext::functionNamed, scene, o);
    if (!renderer) return renderer.error();
    if (auto sized = (*renderer)->resize(o.size, camera); !sized) return sized;
    for (int i = 0; i < o.frames.value_or(2); ++i) {
        if (!o.bake.empty()) (*renderer)->set(momentOf(scene, i));
        if (auto rendered = (*renderer)->render(camera); !rendered) return rendered;
    }
    auto composed = (*renderer)->read((*renderer)->targets().composed, 3);
    if (!composed) return composed.error();
    if (auto fine = checkErrors("while frames were rendered"); !fine) return fine;
    glFinish(); // timings never wait
    const auto timings = (*renderer)->timings();
    return writePicture(o, scene.name, device, upsideDown(*composed),
                        timings ? std::span<const PassTiming>(*timings) : std::span<const PassTiming>(),
                        (*renderer)->memoryUse());
}

Result<> run(const Options& o, const lab::Scene& scene, const lab::CameraView& camera) {
#ifdef REBOUND_HAS_WINDOW
    if (o.window) return showWindow(o, scene, camera);
#endif
    auto context = OpenGLContext::create(host::OpenGLApi::desktop);
    if (!context) return context.error();
    const std::string device = context->description();
    if (auto found = host::requireDevice(device, o.device); !found) return found;
    if (auto done = renderToFile(o, device, scene, camera); !done) return done;
    const std::vector<std::string> messages = context->takeMessages();
    if (o.validation && !messages.empty())
        return Error{ErrorCode::invalidData, "validation: " + messages.front()};
    return {};
}

} // namespace
} // namespace rebound::engine

int main(int argc, char** argv) {
    rebound::engine::ProgramText program;
    program.name = "rebound_opengl_engine";
    program.description = "A small deferred renderer on OpenGL with Rebound's indirect light.";
    program.out = "opengl_engine.png";
    program.device = "part of the device's name: fail if the system has chosen another";
    program.validation = "fail on messages of OpenGL's debug output";
#ifdef REBOUND_HAS_WINDOW
    program.window = true;
#endif
    return rebound::engine::runProgram(argc, argv, program, rebound::engine::run);
}
