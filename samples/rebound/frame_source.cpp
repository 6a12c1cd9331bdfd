// SPDX-License-Identifier: MIT
#include "frame_source.hpp"

#include "lab/rays/frame_check.hpp"
#include "lab/scenes/scene_files.hpp"
#include "progress.hpp"

#include <cmath>
#include <filesystem>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

Result<lab::Scene> loadSceneOf(const SourceOptions& options) {
    if (auto valid = checkSource(options); !valid) return valid.error();
    return lab::loadScene(options.scene, options.view, {options.animation, options.time, {}});
}

Result<lab::Frame> renderSource(const SourceOptions& options, Extent2D extent, int threads) {
    const auto view = loadView(options);
    if (!view) return view.error();
    ProgressLine line("rendering the G-buffer and direct light");
    lab::FrameOptions frameOptions;
    frameOptions.extent = extent;
    frameOptions.lightSamples = options.lightSamples;
    frameOptions.threads = threads;
    frameOptions.progress = [&line](double share) { line.update(share); };
    return lab::renderFrame(view->scene, view->camera, frameOptions);
}

} // namespace

Result<> checkSource(const SourceOptions& options) {
    if (options.scene.empty())
        return invalidArgument("SCENE is empty; a glTF file, " + lab::builtinSceneList() + " was expected");
    if (options.time && !std::isfinite(*options.time))
        return invalidArgument("--time is not finite; a number of seconds was expected");
    if ((options.animation || options.time) && options.scene.starts_with("builtin:"))
        return invalidArgument("--time and --animation need a glTF file, but the scene is " + options.scene +
                               ", which has no animation");
    return {};
}

Result<SourcedView> loadView(const SourceOptions& options) {
    auto scene = loadSceneOf(options);
    if (!scene) return scene.error();
    auto camera = lab::findCamera(*scene, options.camera);
    if (!camera) return camera.error();
    return SourcedView{*std::move(scene), *std::move(camera)};
}

Result<SourcedFrame> obtainFrame(const SourceOptions& options, Extent2D extent, int threads) {
    SourcedFrame source;
    source.isStored = !options.frame.empty();
    source.name = source.isStored ? options.frame : options.scene;
    auto frame = source.isStored ? lab::readFrame(options.frame, options.view, options.camera)
                                 : renderSource(options, extent, threads);
    if (!frame) return frame.error();
    source.frame = *std::move(frame);
    const std::string prefix = source.isStored ? "" : "'" + source.name + "': the rendered ";
    const fs::path folder = source.isStored ? fs::path(options.frame) : fs::path();
    const auto nameOfImage = [&](const char* image) {
        return source.isStored ? (folder / (std::string(image) + ".exr")).string() : prefix + image;
    };
    if (auto valid = lab::checkFrame(source.frame, nameOfImage); !valid) return valid.error();
    return source;
}

} // namespace rebound::cli
