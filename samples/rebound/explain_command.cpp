// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "frame_source.hpp"
#include "lab/explain/error_causes.hpp"
#include "memory_check.hpp"
#include "options.hpp"
#include "output_folder.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "reference_render.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <memory>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

// The frame takes 52, results on the way to the truth and their differences 25 images of 12, a plan at full resolution 100,
// pictures of all of it 60.
constexpr double bytesPerPixel = 520.0;

using explain::Cause;
using explain::Explanation;

struct ExplainCommandOptions {
    SourceOptions source;
    TechniqueOptions technique;
    int bounces = 8;
    int samples = 256;
    int threads = 0;
    bool json = false;
    std::string out;
};

std::string percent(double share) { return formatted("%+.2f", 100.0 * share); }

void addRow(std::string& text, const std::string& name, const Cause& cause, const std::string& part) {
    text += formatted("%-24s %10s %10s %10s  ", name.c_str(), percent(cause.bias).c_str(),
                      formatted("%.2f", 100.0 * cause.rms).c_str(), part.c_str()) +
            cause.meaning + "\n";
}

std::string tableOf(const Explanation& explanation) {
    std::string text = formatted("%-24s %10s %10s %10s  %s\n", "cause, in % of the mean", "bias", "alone",
                                 "part", "what is switched");
    for (const Cause& cause : explanation.causes) addRow(text, cause.name, cause, percent(cause.part));
    text += std::string(60, '-') + "\n";
    addRow(text, explanation.whole.name, explanation.whole, percent(explanation.whole.part));
    if (explanation.screenLimit) addRow(text, explanation.screenLimit->name, *explanation.screenLimit, "");
    return text + formatted("the truth's own noise is at most %.2f %% of its mean, root mean square\n",
                            100.0 * explanation.noise);
}

Json toJson(const Cause& cause) {
    return {{"name", cause.name},
            {"meaning", cause.meaning},
            {"bias", cause.bias},
            {"rms", cause.rms},
            {"part", cause.part}};
}

Json toJson(const ExplainCommandOptions& options, const lab::CameraView& camera, Extent2D extent,
            const Json& settings, const Explanation& explanation) {
    Json json;
    json["scene"] = options.source.scene;
    json["camera"] = camera.name;
    json["resolution"] = {extent.width, extent.height};
    json["technique"] = options.technique.name;
    json["settings"] = settings;
    json["bounces"] = options.bounces;
    json["samples"] = options.samples;
    json["truth_mean"] = explanation.truthMean;
    json["causes"] = Json::array();
    for (const Cause& cause : explanation.causes) json["causes"].push_back(toJson(cause));
    json["whole"] = toJson(explanation.whole);
    if (explanation.screenLimit) json["screen_limit"] = toJson(*explanation.screenLimit);
    json["noise"] = explanation.noise;
    return json;
}

std::string fileNameOf(const std::string& cause) {
    std::string name = cause;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name + ".png";
}

// Truth and result under one tone curve, then every cause's difference under one scale.
lab::Picture sheetOf(const Explanation& explanation, double scale, const lab::ToneCurve& curve) {
    std::vector<lab::CaptionedPicture> pictures = {{"truth, E / pi", lab::toneMap(explanation.truth, curve)},
                                                   {"result", lab::toneMap(explanation.result, curve)}};
    const auto add = [&](const Cause& cause) {
        pictures.push_back({cause.name, differencePicture(cause.difference, scale)});
    };
    add(explanation.whole);
    for (const Cause& cause : explanation.causes) add(cause);
    if (explanation.screenLimit) add(*explanation.screenLimit);
    return lab::contactSheet(pictures, 3);
}

Result<> writePictures(const ExplainCommandOptions& options, const Explanation& explanation,
                       const Json& json) {
    // Differences beyond three times the whole error's are rare, and shown in the strongest colour.
    const double scale = 3.0 * explanation.whole.rms * explanation.truthMean;
    const lab::ToneCurve curve = lab::automaticToneCurve(explanation.truth);
    std::vector<const Cause*> causes = {&explanation.whole};
    if (explanation.screenLimit) causes.push_back(&*explanation.screenLimit);
    for (const Cause& cause : explanation.causes) causes.push_back(&cause);
    std::vector<OutputFile> files;
    for (const Cause* cause : causes)
        files.push_back({fileNameOf(cause->name), [cause, scale](const fs::path& path) {
                             return lab::writePng(path, differencePicture(cause->difference, scale));
                         }});
    files.push_back({"contact_sheet.png", [&](const fs::path& path) {
                         return lab::writePng(path, sheetOf(explanation, scale, curve));
                     }});
    files.push_back(textFile("causes.json", toText(json)));
    if (auto written = writeOutputFolder(options.out, files); !written) return written;
    if (!options.json)
        std::cout
            << formatted(
                   "differences of +-%.4g W m^-2 sr^-1 from blue (too dark) over white to red (too bright)\n",
                   scale)
            << "written to " << options.out << '\n';
    return {};
}

Result<> explainScene(const ExplainCommandOptions& options) {
    const auto extent = parseSize(options.technique.size);
    if (!extent) return extent.error();
    const auto technique = techniqueOf(options.technique);
    if (!technique) return technique.error();
    const auto configured = configure(options.technique, {*extent});
    if (!configured) return configured.error();
    ReferenceOptions reference;
    reference.bounces = options.bounces;
    reference.samples = options.samples;
    if (auto valid = pathTracerOptionsOf(reference, *extent, options.threads); !valid) return valid.error();
    if (options.bounces < 1) return invalidArgument("--bounces is 0; 1 to 64 was expected");
    if (auto enough = checkMemory(*extent, bytesPerPixel); !enough) return enough;
    if (!options.out.empty())
        if (auto writable = checkOutputFolder(options.out); !writable) return writable;
    const auto view = loadView(options.source);
    if (!view) return view.error();

    explain::ExplainOptions explaining;
    explaining.technique = *technique;
    explaining.draft = options.technique.draft;
    explaining.extent = *extent;
    explaining.bounces = options.bounces;
    explaining.samples = options.samples;
    explaining.threads = options.threads;
    const auto explanation = [&] {
        ProgressLine line("switching causes to truth");
        explaining.progress = [&line](double share) { line.update(share); };
        return explain::explainError(view->scene, view->camera, explaining);
    }();
    if (!explanation) return explanation.error();
    const Json json = toJson(options, view->camera, *extent, configured->settings, *explanation);
    if (options.json) std::cout << toText(json);
    else
        std::cout << options.source.scene << ", camera " << view->camera.name << ", "
                  << options.technique.size << ", " << configured->name
                  << formatted(", against %d bounces, %d paths a pixel; mean %.4g W m^-2 sr^-1\n",
                               options.bounces, options.samples, explanation->truthMean)
                  << tableOf(*explanation);
    printNotes(view->scene.notes, options.json ? std::cerr : std::cout);
    return options.out.empty() ? Result<>() : writePictures(options, *explanation, json);
}

} // namespace

Command addExplainCommand(CLI::App& program) {
    auto options = std::make_shared<ExplainCommandOptions>();
    options->technique.size = "320x180";
    CLI::App* app =
        program.add_subcommand("explain", "say how much of the technique's error has which cause");
    addSceneOptions(*app, options->source);
    addTechniqueSettings(*app, options->technique);
    app->get_option("--size")->description(
        "of the pictures [pixels]; the sums over all pixels grow with its square\n(default: 320x180)");
    app->add_option("--bounces", options->bounces, "of the truth, 1 to 64 (default: 8)")
        ->option_text("N")
        ->group(referenceGroup);
    app->add_option("--spp", options->samples, "paths a pixel, 1 to 1048576 (default: 256)")
        ->option_text("N")
        ->group(referenceGroup);
    app->add_option("--threads", options->threads, "1 to 1024; 0: one a core (default: 0)")
        ->option_text("N")
        ->group(deviceGroup);
    app->add_flag("--json", options->json, "write the table as JSON to standard output")->group("Output");
    app->add_option("--out", options->out, "folder for a picture of every cause (default: none are written)")
        ->option_text("DIR")
        ->group("Output");
    app->footer(
        "Each row switches one cause to truth, in this order, and tells what that changed:\n"
        "  bias   its mean; the rows add up to the whole error's\n"
        "  alone  its root mean square\n"
        "  part   what it adds to the whole error's root mean square; the rows add up to it, and one\n"
        "         that offsets others is negative\n"
        "The screen-space limit is what a method would miss that computed without error all that the screen\n"
        "shows: only errors that offset each other can do better.\n"
        "\n"
        "Examples:\n"
        "  rebound explain builtin:cornell --out causes\n"
        "  rebound explain scene.gltf --camera front --preset half-256 --bounces 1 --spp 1024");
    return [options] { return exitCodeOf(explainScene(*options)); };
}

} // namespace rebound::cli
