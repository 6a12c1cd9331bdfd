// SPDX-License-Identifier: MIT
#include "options.hpp"
#include "renderer.hpp"
#ifdef REBOUND_HAS_WINDOW
#include "window.hpp"
#endif

#include "lab/camera_rays.hpp"
#include "lab/image_files.hpp"
#include "lab/scene_files.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>

namespace rebound::engine {
namespace {

void printTimings(const Renderer& renderer, int frame) {
    const auto timings = renderer.indirectLight().timings(frame);
    if (!timings) return;
    double sum = 0.0;
    for (const PassTiming& t : *timings) {
        std::printf("%9.3f ms  %s\n", t.milliseconds, t.label.c_str());
        sum += t.milliseconds;
    }
    if (!timings->empty()) std::printf("%9.3f ms  Rebound, in all\n", sum);
    std::printf("%9.2f MB  Rebound's memory\n", double(renderer.indirectLight().memoryUse().total()) * 1e-6);
}

// Renders frames, each after the one before is done, and writes the last one.
Result<> renderToFile(const Options& o, const host::VulkanContext& context, const lab::Scene& scene,
                      const lab::CameraView& camera) {
    auto renderer = Renderer::create(context, scene, o.preset);
    if (!renderer) return renderer.error();
    if (auto sized = (*renderer)->resize(o.size, camera); !sized) return sized;
    const int frames = o.frames.value_or(2);
    for (int i = 0; i < frames; ++i) {
        const auto done = context.run(
            [&](VkCommandBuffer commands) { return (*renderer)->record(commands, i % framesInFlight, camera); });
        if (!done) return done;
    }
    auto composed = (*renderer)->read((*renderer)->targets().composed, 3);
    if (!composed) return composed.error();
    const lab::ToneCurve curve = lab::automaticToneCurve(*composed);
    if (auto written = lab::writePng(o.out, lab::toneMap(*composed, curve)); !written) return written;
    std::printf("%s, %d x %d, preset %s, on %s\n", scene.name.c_str(), o.size.width, o.size.height, o.preset.c_str(),
                context.deviceName().c_str());
    printTimings(**renderer, (frames - 1) % framesInFlight);
    std::printf("written to %s, exposure %g\n", o.out.c_str(), double(curve.exposure));
    return {};
}

Result<> run(const Options& o) {
    if (auto known = screenIndirectPreset(o.preset, o.size); !known)
        return Error{known.error().code, "--" + known.error().message};
    auto scene = lab::loadScene(o.scene, o.view);
    if (!scene) return scene.error();
    auto camera = lab::findCamera(*scene, o.camera);
    if (!camera) return camera.error();
    if (auto valid = lab::validate(*camera); !valid) return valid;
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
    auto done = o.window ? (*window)->show(o, *context, *scene, *camera) : renderToFile(o, *context, *scene, *camera);
#else
    auto done = renderToFile(o, *context, *scene, *camera);
#endif
    if (done && !context->messages().empty())
        return Error{ErrorCode::invalidData, "validation: " + context->messages().front()};
    return done;
}

int fail(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::cerr << "rebound_vulkan_engine: " << message << '\n';
    return 2;
}

bool parseSize(const std::string& text, Extent2D& size) {
    char end = 0;
    const bool read = std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &end) == 2;
    const auto inRange = [](int side) { return side >= 1 && side <= maximumExtent; };
    return read && inRange(size.width) && inRange(size.height);
}

int runProgram(int argc, char** argv) {
    Options o;
    std::string size = "1280x720";
    CLI::App app("A small deferred renderer on Vulkan with Rebound's indirect light.", "rebound_vulkan_engine");
    app.add_option("scene", o.scene, "a glTF 2.0 file, or builtin:atrium or builtin:cornell")->option_text("SCENE");
    app.add_option("--view", o.view, "a view file: cameras and lights (default: view.json beside the scene)");
    app.add_option("--camera", o.camera, "a camera's name (default: the first)");
    app.add_option("--size", size, "WIDTHxHEIGHT in pixels (default: 1280x720)");
    app.add_option("--preset", o.preset, "Rebound's preset (default: quarter-64)");
    app.add_option("--out", o.out, "the picture (default: vulkan_engine.png)");
    app.add_option("--frames", o.frames, "frames to render; the last one is written (default: 2; in a window, until it is closed)");
    app.add_option("--device", o.device, "part of a device's name (default: the first, discrete ones before others)");
    app.add_flag("--validation", o.validation, "run with validation and synchronization validation, and fail on messages");
#ifdef REBOUND_HAS_WINDOW
    app.add_flag("--window", o.window, "show a window instead of writing a picture: drag to turn, scroll to approach");
#endif
    app.footer("Exit code: 0, or 2 with one sentence on standard error.");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        return end.get_exit_code() == int(CLI::ExitCodes::Success) ? app.exit(end) : fail(end.what());
    }
    if (!parseSize(size, o.size))
        return fail("--size is \"" + size + "\"; WIDTHxHEIGHT, each 1 to " + std::to_string(maximumExtent) + " pixels, was expected");
    if (o.frames && *o.frames < 1) return fail("--frames is " + std::to_string(*o.frames) + "; 1 or more was expected");
    const auto done = run(o);
    return done ? 0 : fail(done.error().message);
}

} // namespace
} // namespace rebound::engine

int main(int argc, char** argv) {
    try {
        return rebound::engine::runProgram(argc, argv);
    } catch (const std::exception& failure) {
        return rebound::engine::fail(failure.what());
    }
}
