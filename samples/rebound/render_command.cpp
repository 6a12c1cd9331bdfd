// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "frame_source.hpp"
#include "lab/images/image_files.hpp"
#include "lab/measure/frame_pipeline.hpp"
#include "lab/runner/texels.hpp"
#include "options.hpp"
#include "output_folder.hpp"
#include "pictures.hpp"
#include "reference_render.hpp"
#include "report.hpp"
#include "sequence_render.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* reference = "reference"; // --technique, beside those that run on devices

struct RenderOptions {
    SourceOptions source;
    TechniqueOptions technique;
    ReferenceOptions reference;
    SequenceChoice sequence;
    DeviceChoice device;
    std::string out = "out";
};

std::vector<OutputFile> imageFiles(const RenderedImages& images, const lab::ToneCurve& curve,
                                   runner::Precision hostPrecision) {
    const auto precision =
        hostPrecision == runner::Precision::half ? lab::ExrPrecision::half : lab::ExrPrecision::full;
    std::vector<OutputFile> files;
    const auto add = [&](const std::string& name, const lab::Image& image) {
        files.push_back({name + ".exr", [&image, precision](const fs::path& path) {
                             return lab::writeExr(path, image, precision);
                         }});
        files.push_back({name + ".png", [&image, &curve](const fs::path& path) {
                             return lab::writePng(path, lab::toneMap(image, curve));
                         }});
    };
    add("direct", images.direct);
    add("indirect", images.indirect);
    add("final", images.final);
    return files;
}

Json timingsToJson(Json json, const std::vector<PassTiming>& timings, double frameMilliseconds) {
    json["passes"] = Json::array();
    for (const PassTiming& pass : timings)
        json["passes"].push_back({{"name", pass.label}, {"ms", pass.milliseconds}});
    json["frame"] = {{"ms", frameMilliseconds}};
    return json;
}

std::string timingTable(const std::vector<PassTiming>& timings, double frameMilliseconds) {
    std::vector<TableRow> rows;
    for (const PassTiming& pass : timings) rows.push_back({pass.label, {pass.milliseconds}});
    rows.push_back({"frame", {frameMilliseconds}});
    return toTable({"pass", "ms"}, rows);
}

// The first frame after the plan was compiled pays for memory that was not touched before; one that follows is measured,
// the last that the picture needs to settle.
Result<double> runMeasured(measure::FramePipeline& pipeline) {
    for (int i = 1; i < std::max(2, pipeline.technique().settlingFrames); ++i)
        if (auto before = pipeline.run(); !before) return before;
    return pipeline.run();
}

void printLimited(const measure::FramePipeline& pipeline) {
    if (pipeline.limitedPixels() > 0)
        std::cout << "note: radiance above " << runner::largestHalf << " W m^-2 sr^-1 was limited to it in "
                  << pipeline.limitedPixels() << " pixels\n";
}

Result<> render(const RenderOptions& options) {
    auto preparation = prepare(options.technique, options.device);
    if (!preparation) return preparation.error();
    if (auto writable = checkOutputFolder(options.out); !writable) return writable;
    const auto source = obtainFrame(options.source, preparation->extent, options.device.threads);
    if (!source) return source.error();
    const auto notes = notesOf(*source, options.device.threads);
    if (!notes) return notes.error();
    auto configured = configureFor(*source, options.technique, options.device.threads);
    if (!configured) return configured.error();
    auto pipeline = measure::FramePipeline::create(source->frame, *std::move(configured),
                                                   *preparation->backend, preparation->precision);
    if (!pipeline) return pipeline.error();
    const auto milliseconds = runMeasured(*pipeline);
    if (!milliseconds) return milliseconds.error();

    auto indirect = pipeline->indirect(), composed = pipeline->composed();
    if (!indirect) return indirect.error();
    if (!composed) return composed.error();
    const RenderedImages images{pipeline->direct(), *std::move(indirect), *std::move(composed)};
    const lab::ToneCurve curve = lab::automaticToneCurve(images.final);
    Json figures = timingsToJson(runToJson(*source, pipeline->technique(), preparation->backend->info(),
                                           preparation->precision, pipeline->memoryUse()),
                                 pipeline->timings(), *milliseconds);
    figures["exposure"] = curve.exposure;
    std::vector<OutputFile> files = imageFiles(images, curve, preparation->precision);
    files.push_back({"contact_sheet.png", [&](const fs::path& path) {
                         return lab::writePng(path, contactSheetOf(images, source->frame, curve));
                     }});
    files.push_back(textFile("timings.json", toText(figures)));
    if (auto written = writeOutputFolder(options.out, files); !written) return written;

    std::cout << describeRun(*source, pipeline->technique(), preparation->backend->info(),
                             preparation->precision)
              << '\n'
              << timingTable(pipeline->timings(), *milliseconds) << "\nmemory "
              << toText(pipeline->memoryUse()) << "\nexposure " << curve.exposure
              << ", then 1 - exp(-x) and sRGB, in every picture\n";
    printLimited(*pipeline);
    printNotes(*notes, std::cout);
    printNotes(pipeline->technique().notes, std::cout);
    std::cout << "written to " << options.out << ":";
    for (const OutputFile& file : files) std::cout << ' ' << file.name;
    std::cout << '\n';
    return {};
}

// Options that the chosen technique would ignore are mistakes; those of other techniques are techniqueOf()'s to refuse.
Result<> checkOptions(const CLI::App& app, const RenderOptions& options) {
    const bool traced = options.technique.name == reference;
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_lnames().empty() ? "" : option->get_lnames()[0];
        const bool ignored = traced ? options.technique.draft.contains(name) ||
                                          (option->get_group() == deviceGroup && name != "threads") ||
                                          option->get_group() == sequenceGroup || name == "frame" ||
                                          name == "light-samples"
                                    : option->get_group() == referenceGroup;
        if (option->count() > 0 && ignored)
            return invalidArgument("--" + name + " was given, which --technique " + options.technique.name +
                                   " does not use");
    }
    return {};
}

Result<> renderChosen(const CLI::App& app, const RenderOptions& options) {
    if (options.technique.name != reference)
        if (auto known = techniques::named("--technique", options.technique.name); !known)
            return invalidArgument("--technique is \"" + options.technique.name + "\"; one of " +
                                   techniques::names() + ", " + reference + " was expected");
    if (auto valid = checkOptions(app, options); !valid) return valid;
    if (options.technique.name == reference)
        return renderReference(options.source, options.technique.size, options.device.threads,
                               options.reference, options.out);
    if (options.sequence.isAsked())
        return renderSequence(options.source, options.technique, options.device, options.sequence,
                              options.out);
    if (options.sequence.path || options.sequence.framesPerSecond)
        return invalidArgument("--frames is missing; --path and --fps need a number of frames");
    return render(options);
}

} // namespace

Command addRenderCommand(CLI::App& program) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* app = program.add_subcommand("render", "render a scene or a stored frame with indirect light");
    addSourceOptions(*app, options->source);
    app->add_option("--technique", options->technique.name,
                    "one of " + techniques::names() +
                        ", or reference: path-traced truth\n(default: " + options->technique.name + ")")
        ->option_text("NAME")
        ->group(techniqueGroup);
    addTechniqueOptions(*app, options->technique);
    addReferenceOptions(*app, options->reference);
    addSequenceOptions(*app, options->sequence);
    addDeviceOptions(*app, options->device);
    excludeSceneOptionsFromFrames(*app);
    app->add_option("--out", options->out,
                    "folder for the outputs, created where it is missing (default: out)")
        ->option_text("DIR")
        ->group("Output");
    app->footer(
        "Outputs, linear Rec. 709, in half precision or, with --precision float, in single:\n"
        "  direct.exr    emission + albedo * E / pi, E straight from the lights [W m^-2 sr^-1]\n"
        "  indirect.exr  E / pi of light that met one other surface, albedo not in it\n"
        "  final.exr     direct + albedo * indirect\n"
        "  direct.png, indirect.png, final.png: the same through one tone curve\n"
        "  contact_sheet.png: these, albedo, normals and depth\n"
        "  timings.json: milliseconds of every pass in one frame, memory [bytes], settings\n"
        "Every surface is Lambertian and sends its direct light and emission to the others.\n"
        "--technique reference writes direct.exr and indirect.exr as E / pi, E of light that met 0 or\n"
        "1 to --bounces surfaces before, first_bounce.exr, standard_error.exr (of indirect's luminance),\n"
        "and the frame with meta.json, so that --frame takes the folder. It goes on where an\n"
        "interrupted run, or one with fewer paths, has left a .paths file in the folder.\n"
        "\n"
        "Examples:\n"
        "  rebound render\n"
        "  rebound render scene.gltf --camera front --size 1920x1080 --preset half-64 --out front\n"
        "  rebound render builtin:cornell --size 512x512 --levels 5 --radius auto --only-level 2\n"
        "  rebound render builtin:cornell --technique reference --size 320x180 --bounces 1 --error 0.01\n"
        "  rebound render --frame captured --preset half-256 --precision float\n"
        "  rebound render builtin:street --frames 150 --size 640x360 --out walk");
    return [app, options] { return exitCodeOf(renderChosen(*app, *options)); };
}

} // namespace rebound::cli
