// SPDX-License-Identifier: MIT
#include "frame_source.hpp"

#include "lab/examine/frame_examination.hpp"
#include "lab/rays/frame_check.hpp"
#include "lab/scenes/scene_files.hpp"
#include "progress.hpp"

#include <cmath>
#include <filesystem>
#include <ostream>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

Result<lab::Scene> loadSceneOf(const SourceOptions& options) {
    if (auto valid = checkSource(options); !valid) return valid.error();
    return lab::loadScene(options.scene, options.view, {options.animation, options.time, {}});
}

Result<> renderInto(SourcedFrame& source, const SourceOptions& options, Extent2D extent, int threads) {
    auto view = loadView(options);
    if (!view) return view.error();
    ProgressLine line("rendering the G-buffer and direct light");
    lab::FrameOptions frameOptions;
    frameOptions.extent = extent;
    frameOptions.lightSamples = options.lightSamples;
    frameOptions.threads = threads;
    frameOptions.progress = [&line](double share) { line.update(share); };
    auto frame = lab::renderFrame(view->scene, view->camera, frameOptions);
    if (!frame) return frame.error();
    source.frame = *std::move(frame);
    source.notes = view->scene.notes;
    source.scene = std::make_shared<const lab::Scene>(std::move(view->scene));
    return {};
}

Result<> readInto(SourcedFrame& source, const SourceOptions& options) {
    auto frame = lab::readFrame(options.frame, options.view, options.camera);
    if (!frame) return frame.error();
    source.frame = *std::move(frame);
    source.notes = source.frame.notes;
    return {};
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

Result<SourcedFrame> obtainFrame(const SourceOptions& options, Extent2D extent, int threads,
                                 WrongPixels wrongPixels) {
    SourcedFrame source;
    source.isStored = !options.frame.empty();
    source.name = source.isStored ? options.frame : options.scene;
    auto obtained =
        source.isStored ? readInto(source, options) : renderInto(source, options, extent, threads);
    if (!obtained) return obtained.error();
    if (wrongPixels == WrongPixels::refuse)
        if (auto valid = checkPixels(source); !valid) return valid.error();
    return source;
}

Result<> checkPixels(const SourcedFrame& source) {
    const std::string prefix = source.isStored ? "" : "'" + source.name + "': the rendered ";
    const fs::path folder = source.isStored ? fs::path(source.name) : fs::path();
    const auto nameOfImage = [&](const char* image) {
        return source.isStored ? (folder / (std::string(image) + ".exr")).string() : prefix + image;
    };
    return lab::checkFrame(source.frame, nameOfImage);
}

Result<std::vector<std::string>> notesOf(const SourcedFrame& source, int threads) {
    std::vector<std::string> notes = source.notes;
    if (!source.isStored) return notes;
    const auto findings = examine::examineFrame(source.frame, threads);
    if (!findings) return findings.error();
    for (const InputFinding& finding : *findings) notes.push_back(finding.sentence);
    return notes;
}

Result<techniques::Configured> configureFor(const SourcedFrame& source, const TechniqueOptions& options,
                                            int threads) {
    auto configured = configure(options, techniques::viewOf(source.frame));
    if (!configured) return configured;
    ProgressLine line("baking");
    const auto progress = [&line](std::string_view step, double share) {
        line.begin("baking: " + std::string(step));
        line.update(share);
    };
    return techniques::completed(*std::move(configured), {source.scene, threads, progress}, source.name);
}

void printNotes(const std::vector<std::string>& notes, std::ostream& stream) {
    for (const std::string& note : notes) stream << "note: " << note << '\n';
}

} // namespace rebound::cli
