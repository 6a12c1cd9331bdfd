// SPDX-License-Identifier: MIT
#include "frame_source.hpp"

#include "frame_check.hpp"
#include "lab/scene_files.hpp"
#include "progress.hpp"

#include <cmath>
#include <filesystem>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

bool isBuiltin(const SourceOptions& options) {
    return options.scene.starts_with("builtin:");
}

fs::path viewFileOf(const SourceOptions& options) {
    if (!options.view.empty())
        return options.view;
    const fs::path beside = fs::path(options.scene).parent_path() / "view.json";
    std::error_code failure;
    return fs::exists(beside, failure) ? beside : fs::path();
}

// The moment that the options ask for, where they leave it open that of the view file.
Result<lab::GltfOptions> momentOf(const SourceOptions& options) {
    lab::GltfOptions moment;
    if (const fs::path view = viewFileOf(options); !view.empty()) {
        auto stored = lab::readViewAnimation(view);
        if (!stored)
            return stored.error();
        moment = *stored;
    }
    // Another clip's moment means nothing to this one.
    if (options.animation && *options.animation != moment.animation)
        moment.time = 0.0f;
    moment.animation = options.animation.value_or(moment.animation);
    moment.time = options.time.value_or(moment.time);
    moment.animate = true;
    return moment;
}

// The scene as it stands at another moment: its surfaces move, and the cameras and lights of a view file
// stay.
Result<> moveTo(lab::Scene& scene, const SourceOptions& options) {
    const auto moment = momentOf(options);
    if (!moment)
        return moment.error();
    auto moved = lab::loadGltf(options.scene, *moment);
    if (!moved)
        return moved.error();
    scene.meshes = std::move(moved->meshes);
    if (viewFileOf(options).empty()) {
        scene.lights = std::move(moved->lights);
        if (!moved->cameras.empty())
            scene.cameras = std::move(moved->cameras);
    }
    if (auto valid = lab::validate(scene); !valid)
        return Error{valid.error().code, "'" + options.scene + "': " + valid.error().message};
    return {};
}

Result<lab::Scene> loadSceneOf(const SourceOptions& options) {
    const bool moves = options.animation || options.time;
    if (options.scene.empty())
        return invalidArgument("SCENE is empty; a glTF file, builtin:atrium or builtin:cornell was expected");
    if (options.time && !std::isfinite(*options.time))
        return invalidArgument("--time is not finite; a number of seconds was expected");
    if (moves && isBuiltin(options))
        return invalidArgument("--time and --animation need a glTF file, but the scene is " + options.scene +
                               ", which does not move");
    auto scene = lab::loadScene(options.scene, options.view);
    if (!scene || !moves)
        return scene;
    if (auto moved = moveTo(*scene, options); !moved)
        return moved.error();
    return scene;
}

Result<lab::Frame> renderSource(const SourceOptions& options, Extent2D extent, int threads) {
    auto scene = loadSceneOf(options);
    if (!scene)
        return scene.error();
    auto camera = lab::findCamera(*scene, options.camera);
    if (!camera)
        return camera.error();
    ProgressLine line("rendering the G-buffer and direct light");
    lab::FrameOptions frameOptions;
    frameOptions.extent = extent;
    frameOptions.lightSamples = options.lightSamples;
    frameOptions.threads = threads;
    frameOptions.progress = [&line](double share) { line.update(share); };
    return lab::renderFrame(*scene, *camera, frameOptions);
}

} // namespace

Result<SourcedFrame> obtainFrame(const SourceOptions& options, Extent2D extent, int threads) {
    SourcedFrame source;
    source.isStored = !options.frame.empty();
    source.name = source.isStored ? options.frame : options.scene;
    auto frame = source.isStored ? lab::readFrame(options.frame, options.view, options.camera)
                                 : renderSource(options, extent, threads);
    if (!frame)
        return frame.error();
    source.frame = *std::move(frame);
    const std::string prefix = source.isStored ? "" : "'" + source.name + "': the rendered ";
    const fs::path folder = source.isStored ? fs::path(options.frame) : fs::path();
    const auto nameOfImage = [&](const char* image) {
        return source.isStored ? (folder / (std::string(image) + ".exr")).string() : prefix + image;
    };
    if (auto valid = checkFrame(source.frame, nameOfImage); !valid)
        return valid.error();
    return source;
}

} // namespace rebound::cli
