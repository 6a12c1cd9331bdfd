// SPDX-License-Identifier: MIT
#include "renderer.hpp"
#ifdef REBOUND_HAS_WINDOW
#include "window.hpp"
#endif

#include "lab/engine/command_line.hpp"

namespace rebound::engine {
namespace {

#ifdef REBOUND_HAS_WINDOW
constexpr bool hasWindow = true;
#else
constexpr bool hasWindow = false;
#endif

// Renders frames, each after the one before is done, and writes the last one.
Result<> renderToFile(const Options& o, const host::VulkanContext& context, const lab::Scene& scene,
                      const lab::CameraView& camera) {
    auto renderer = createRenderer(context, scene, o);
    if (!renderer) return renderer.error();
    if (auto sized = (*renderer)->resize(o.size, camera); !sized) return sized;
    const int frames = o.frames.value_or(2);
    for (int i = 0; i < frames; ++i) {
        if (!o.bake.empty()) (*renderer)->set(momentOf(scene, i), i % framesInFlight);
        const auto done = context.run([&](VkCommandBuffer commands) {
            return (*renderer)->record(commands, i % framesInFlight, camera);
        });
        if (!done) return done;
    }
    auto composed = (*renderer)->read((*renderer)->targets().composed, 3);
    if (!composed) return composed.error();
    const auto timings = (*renderer)->timings();
    return writePicture(o, scene.name, context.deviceName(), *composed,
                        timings ? std::span<const PassTiming>(*timings) : std::span<const PassTiming>(),
                        (*renderer)->memoryUse());
}

Result<> run(const Options& o, const lab::Scene& scene, const lab::CameraView& camera) {
    host::VulkanOptions options;
    options.device = o.device;
    options.validation = o.validation;
#ifdef REBOUND_HAS_WINDOW
    auto window = o.window ? Window::create(o.size, options) : Result<std::unique_ptr<Window>>(nullptr);
    if (!window) return window.error();
#endif
    auto context = host::VulkanContext::create(options);
    if (!context) return context.error();
#ifdef REBOUND_HAS_WINDOW
    auto done =
        o.window ? (*window)->show(o, *context, scene, camera) : renderToFile(o, *context, scene, camera);
#else
    auto done = renderToFile(o, *context, scene, camera);
#endif
    if (done && !context->messages().empty())
        return Error{ErrorCode::invalidData, "validation: " + context->messages().front()};
    return done;
}

} // namespace
} // namespace rebound::engine

int main(int argc, char** argv) {
    rebound::engine::ProgramText program;
    program.name = "rebound_vulkan_engine";
    program.description = "A small deferred renderer on Vulkan with Rebound's indirect light.";
    program.out = "vulkan_engine.png";
    program.device = "part of a device's name (default: the first, discrete ones before others)";
    program.validation = "run with validation and synchronization validation, and fail on messages";
    program.window = rebound::engine::hasWindow;
    return rebound::engine::runProgram(argc, argv, program, rebound::engine::run);
}
