// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "moment.hpp"

#include "lab/files/command_line_error.hpp"
#include "lab/images/image_files.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/scenes/scene_files.hpp"
#ifdef REBOUND_HAS_BAKE
#include "rebound/bake/bake_file.hpp"
#endif
#include "rebound/techniques/screen_indirect.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

namespace rebound::engine {
namespace {

using Run = std::function<Result<>(const Options&, const lab::Scene&, const lab::CameraView&)>;

int fail(const ProgramText& program, std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::cerr << program.name << ": " << message << '\n';
    return 2;
}

bool parseSize(const std::string& text, Extent2D& size) {
    char end = 0;
    const bool read = std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &end) == 2;
    const auto inRange = [](int side) { return side >= 1 && side <= maximumExtent; };
    return read && inRange(size.width) && inRange(size.height);
}

Result<> loadAndRun(const Options& o, const Run& run) {
    if (auto known = screenIndirectPreset(o.preset, o.size); !known)
        return Error{known.error().code, "--" + known.error().message};
    auto scene = lab::loadScene(o.scene, o.view);
    if (!scene) return scene.error();
    auto camera = lab::findCamera(*scene, o.camera);
    if (!camera) return camera.error();
    if (auto valid = lab::validate(*camera); !valid) return valid;
    if (!o.bake.empty()) addBall(*scene);
    if (auto done = run(o, *scene, *camera); !done) return done;
    for (const std::string& note : scene->notes) std::printf("note: %s\n", note.c_str());
    return {};
}

int parseAndRun(int argc, char** argv, const ProgramText& program, const Run& run) {
    Options o;
    o.out = program.out;
    std::string size = "1280x720";
    CLI::App app(program.description, program.name);
    app.add_option("scene", o.scene, "a glTF 2.0 file, or " + lab::builtinSceneList())->option_text("SCENE");
    app.add_option("--view", o.view, "a view file: cameras and lights (default: view.json beside the scene)");
    app.add_option("--camera", o.camera, "a camera's name (default: the first)");
    app.add_option("--size", size, "WIDTHxHEIGHT in pixels (default: 1280x720)");
    app.add_option("--preset", o.preset, "Rebound's preset (default: quarter-64)");
    app.add_option("--bake", o.bake,
                   "what rebound bake has made of the scene: its indirect light instead of the screen's,\n"
                   "with a ball and lights that move");
    app.add_option("--out", o.out, "the picture (default: " + program.out + ")");
    app.add_option("--frames", o.frames,
                   "frames to render; the last one is written (default: 2; in a window, until it is closed)");
    app.add_option("--device", o.device, program.device);
    app.add_flag("--validation", o.validation, program.validation);
    if (program.window)
        app.add_flag("--window", o.window,
                     "show a window instead of writing a picture: drag to turn, scroll to approach");
    app.footer("Exit code: 0, or 2 with one sentence on standard error.");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        return end.get_exit_code() == int(CLI::ExitCodes::Success) ? app.exit(end)
                                                                   : fail(program, lab::sentenceOf(app, end));
    }
    if (!parseSize(size, o.size))
        return fail(program, "--size is \"" + size + "\"; WIDTHxHEIGHT, each 1 to " +
                                 std::to_string(maximumExtent) + " pixels, was expected");
    if (o.frames && *o.frames < 1)
        return fail(program, "--frames is " + std::to_string(*o.frames) + "; 1 or more was expected");
    const auto done = loadAndRun(o, run);
    return done ? 0 : fail(program, done.error().message);
}

} // namespace

int runProgram(int argc, char** argv, const ProgramText& program, const Run& run) {
    try {
        return parseAndRun(argc, argv, program, run);
    } catch (const std::bad_alloc&) {
        return fail(program, "out of memory");
    } catch (const std::exception&) {
        return fail(program,
                    "something has failed that should not fail; a report with the command line would help");
    }
}

Result<Bake> bakeOf(const Options& o) {
#ifdef REBOUND_HAS_BAKE
    return readBake(o.bake);
#else
    return Error{ErrorCode::unsupported, "--bake is " + o.bake + "; this build reads no bakes"};
#endif
}

Result<> writePicture(const Options& o, const std::string& scene, const std::string& device,
                      const lab::Image& composed, std::span<const PassTiming> timings,
                      const MemoryUse& memory) {
    const lab::ToneCurve curve = lab::automaticToneCurve(composed);
    if (auto written = lab::writePng(o.out, lab::toneMap(composed, curve)); !written) return written;
    std::printf("%s, %d x %d, %s %s, on %s\n", scene.c_str(), o.size.width, o.size.height,
                o.bake.empty() ? "preset" : "bake", o.bake.empty() ? o.preset.c_str() : o.bake.c_str(),
                device.c_str());
    double sum = 0.0;
    for (const PassTiming& t : timings) {
        std::printf("%9.3f ms  %s\n", t.milliseconds, t.label.c_str());
        sum += t.milliseconds;
    }
    if (!timings.empty()) std::printf("%9.3f ms  Rebound, in all\n", sum);
    std::printf("%9.2f MB  Rebound's memory\n", double(memory.total()) * 1e-6);
    std::printf("written to %s, exposure %g\n", o.out.c_str(), double(curve.exposure));
    return {};
}

} // namespace rebound::engine
