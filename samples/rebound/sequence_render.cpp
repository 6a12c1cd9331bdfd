// SPDX-License-Identifier: MIT
#include "sequence_render.hpp"

#include "frame_source.hpp"
#include "lab/files/run_program.hpp"
#include "lab/images/image_files.hpp"
#include "lab/measure/measurement.hpp"
#include "lab/rays/frame_check.hpp"
#include "lab/sequences/sequence.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

constexpr int mostFrames = 10000;
constexpr double usualFramesPerSecond = 30.0, mostFramesPerSecond = 1000.0;

std::string numbered(const char* base, int number, const char* end) {
    return formatted("%s_%04d%s", base, number, end);
}

Result<lab::MotionPath> pathOf(const SourceOptions& source, const SequenceChoice& choice) {
    if (choice.path) {
        if (choice.path->empty()) return invalidArgument("--path is empty; a file was expected");
        return lab::readPath(*choice.path);
    }
    if (auto own = lab::builtinPath(source.scene)) return *std::move(own);
    if (source.animation || source.time) return lab::MotionPath{};
    return invalidArgument("--path is missing; a file that moves the camera or objects of " + source.scene +
                           ", or --animation, was expected");
}

Result<> checkChoice(const SourceOptions& source, const SequenceChoice& choice) {
    if (*choice.frames < 1 || *choice.frames > mostFrames)
        return invalidArgument("--frames is " + std::to_string(*choice.frames) + "; 1 to " +
                               std::to_string(mostFrames) + " was expected");
    const double fps = choice.framesPerSecond.value_or(usualFramesPerSecond);
    if (!(fps >= 0.01 && fps <= mostFramesPerSecond))
        return invalidArgument(formatted("--fps is %g; 0.01 to 1000 was expected", fps));
    if (!source.frame.empty())
        return invalidArgument(
            "--frames was given with --frame, a single stored frame; a scene was expected");
    return {};
}

// R and G hold the motion.
lab::Image motionPicture(const lab::Frame& frame) {
    lab::Image picture(frame.depth.extent(), 3);
    for (size_t i = 0; i < frame.motion.data.size() / 2; ++i)
        for (size_t c = 0; c < 2; ++c) picture.data[i * 3 + c] = frame.motion.data[i * 2 + c];
    return picture;
}

// Renders one frame after the other, each when its first file is asked for, so that one is held at a time.
class SequenceRun {
public:
    SequenceRun(lab::Sequence scene, const TechniqueOptions& options, Preparation& preparation,
                const SourceOptions& sourceOptions, int threads, int count)
        : sequence(std::move(scene)), technique(options), prepared(preparation), source(sourceOptions),
          progress("rendering frames"), frames(count) {
        frameOptions.extent = preparation.extent;
        frameOptions.lightSamples = source.lightSamples;
        frameOptions.threads = threads;
    }

    // Renders up to this frame; they are asked for in their order.
    Result<> goTo(int number) {
        while (rendered <= number)
            if (auto done = renderNext(); !done) return done;
        return {};
    }

    const lab::ToneCurve& curve() const { return *toneCurve; }
    const lab::Image& light() const { return indirect; }
    const lab::Image& picture() const { return composed; }
    const SourcedFrame& current() const { return frame; }
    const measure::FramePipeline& pipeline() const { return *compiled; }
    const std::vector<double>& milliseconds() const { return times; }

private:
    Result<> renderNext() {
        frameOptions.progress = [this](double share) {
            progress.update((double(rendered) + share) / double(frames));
        };
        auto next = sequence.next(frameOptions);
        if (!next) return next.error();
        frame = SourcedFrame{*std::move(next), source.scene, false, frame.scene, sequence.notes()};
        if (!frame.scene) frame.scene = std::make_shared<const lab::Scene>(sequence.current());
        const auto nameOfImage = [&](const char* image) {
            return "'" + source.scene + "': the rendered " + image;
        };
        if (auto valid = lab::checkFrame(frame.frame, nameOfImage); !valid) return valid;
        if (auto handed = handIn(); !handed) return handed;
        const auto took = compiled->run();
        if (!took) return took.error();
        auto light = compiled->indirect(), all = compiled->composed();
        if (!light) return light.error();
        if (!all) return all.error();
        indirect = *std::move(light);
        composed = *std::move(all);
        times.push_back(*took);
        if (!toneCurve) toneCurve = lab::automaticToneCurve(composed);
        ++rendered;
        return {};
    }

    Result<> handIn() {
        if (compiled) return compiled->setFrame(frame.frame);
        auto configured = configureFor(frame, technique, frameOptions.threads);
        if (!configured) return configured.error();
        auto created = measure::FramePipeline::create(frame.frame, *std::move(configured), *prepared.backend,
                                                      prepared.precision);
        if (!created) return created.error();
        compiled.emplace(*std::move(created));
        return {};
    }

    lab::Sequence sequence;
    const TechniqueOptions& technique;
    Preparation& prepared;
    const SourceOptions& source;
    lab::FrameOptions frameOptions;
    ProgressLine progress;
    int frames;
    int rendered = 0;
    SourcedFrame frame;
    std::optional<measure::FramePipeline> compiled;
    lab::Image indirect, composed;
    std::optional<lab::ToneCurve> toneCurve; // of the first frame, as the eye's would not follow each
    std::vector<double> times;
};

std::vector<OutputFile> frameFiles(SequenceRun& run, int number) {
    // The first of them renders the frame.
    std::vector<OutputFile> files = {
        {numbered("final", number, ".png"), [&run, number](const fs::path& path) -> Result<> {
             if (auto rendered = run.goTo(number); !rendered) return rendered;
             return lab::writePng(path, lab::toneMap(run.picture(), run.curve()));
         }}};
    files.push_back({numbered("indirect", number, ".exr"),
                     [&run](const fs::path& path) { return lab::writeExr(path, run.light()); }});
    if (number > 0)
        files.push_back({numbered("motion", number, ".exr"), [&run](const fs::path& path) {
                             return lab::writeExr(path, motionPicture(run.current().frame),
                                                  lab::ExrPrecision::full);
                         }});
    return files;
}

// From the frames that lie beside it.
OutputFile videoFile(const fs::path& ffmpeg, double framesPerSecond) {
    return {
        "sequence.mp4", [=](const fs::path& path) -> Result<> {
            const fs::path frames = path.parent_path() / "final_%04d.png";
            auto made = lab::runProgram(ffmpeg, {"-y", "-loglevel", "error", "-framerate",
                                                 formatted("%g", framesPerSecond), "-i", frames.string(),
                                                 "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt",
                                                 "yuv420p", path.string()});
            if (made) return {};
            return Error{ErrorCode::unsupported, "ffmpeg could not make the video: " + made.error().message};
        }};
}

Json timingsOf(const SequenceRun& run, const Preparation& preparation, double framesPerSecond) {
    Json json = runToJson(run.current(), run.pipeline().technique(), preparation.backend->info(),
                          preparation.precision, run.pipeline().memoryUse());
    json["frames"] = run.milliseconds().size();
    json["frames_per_second"] = framesPerSecond;
    json["exposure"] = run.curve().exposure;
    json["frame_ms"] = run.milliseconds();
    return json;
}

} // namespace

void addSequenceOptions(CLI::App& app, SequenceChoice& choice) {
    app.add_option("--frames", choice.frames,
                   "render so many frames of the scene in motion, 1 to 10000, to numbered files\n"
                   "and, where ffmpeg is in PATH, a video (default: one still picture)")
        ->option_text("N")
        ->group(sequenceGroup);
    app.add_option("--path", choice.path,
                   "a JSON file that moves camera and objects (default: a built-in scene's own)")
        ->option_text("FILE")
        ->group(sequenceGroup);
    app.add_option("--fps", choice.framesPerSecond, "frames a second of the path, 0.01 to 1000 (default: 30)")
        ->option_text("R")
        ->group(sequenceGroup);
}

Result<> renderSequence(const SourceOptions& source, const TechniqueOptions& technique,
                        const DeviceChoice& device, const SequenceChoice& choice, const std::string& out) {
    if (auto valid = checkChoice(source, choice); !valid) return valid;
    if (auto valid = checkSource(source); !valid) return valid;
    const auto path = pathOf(source, choice);
    if (!path) return path.error();
    auto preparation = prepare(technique, device);
    if (!preparation) return preparation.error();
    if (auto writable = checkOutputFolder(out); !writable) return writable;
    const double fps = choice.framesPerSecond.value_or(usualFramesPerSecond);
    auto sequence = lab::Sequence::open(
        {source.scene, source.view, source.camera, {source.animation, source.time, {}}, *path, fps});
    if (!sequence) return sequence.error();
    SequenceRun run(*std::move(sequence), technique, *preparation, source, device.threads, *choice.frames);

    std::vector<OutputFile> files;
    for (int i = 0; i < *choice.frames; ++i)
        for (OutputFile& file : frameFiles(run, i)) files.push_back(std::move(file));
    const auto ffmpeg = lab::findProgram("ffmpeg");
    if (ffmpeg) files.push_back(videoFile(*ffmpeg, fps));
    files.push_back({"timings.json", [&](const fs::path& file) {
                         return textFile("", toText(timingsOf(run, *preparation, fps))).write(file);
                     }});
    if (auto written = writeOutputFolder(out, files); !written) return written;

    const measure::Series times{"frame", run.milliseconds()};
    std::cout << describeRun(run.current(), run.pipeline().technique(), preparation->backend->info(),
                             preparation->precision)
              << *choice.frames << " frames at " << fps << " a second, median "
              << formatted("%.2f", times.median()) << " ms\nexposure " << run.curve().exposure
              << ", of the first frame, in all pictures\nwritten to " << out
              << ": final_NNNN.png, indirect_NNNN.exr, motion_NNNN.exr, timings.json"
              << (ffmpeg ? ", sequence.mp4\n" : "\nnote: ffmpeg is not in PATH, so that there is no video\n");
    printNotes(run.current().notes, std::cout);
    return {};
}

} // namespace rebound::cli
