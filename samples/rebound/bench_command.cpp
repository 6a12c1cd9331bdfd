// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "frame_source.hpp"
#include "lab/measure/measurement.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <memory>

namespace rebound::cli {

namespace {

struct BenchOptions {
    SourceOptions source;
    TechniqueOptions technique;
    DeviceChoice device;
    int frames = 50;
    int warmUp = 5;
    bool json = false;
};

using measure::Measurement;
using measure::Series;

Json toJson(Json json, const Measurement& measurement, const BenchOptions& options) {
    json["frames"] = options.frames;
    json["warm_up"] = options.warmUp;
    json["passes"] = Json::array();
    for (const Series& pass : measurement.passes)
        json["passes"].push_back(
            {{"name", pass.name}, {"median_ms", pass.median()}, {"minimum_ms", pass.minimum()}});
    json["frame"] = {{"median_ms", measurement.frame.median()}, {"minimum_ms", measurement.frame.minimum()}};
    if (const Series& recording = measurement.recording; !recording.milliseconds.empty())
        json["recording"] = {{"median_ms", recording.median()}, {"minimum_ms", recording.minimum()}};
    return json;
}

// A run of one backend.
struct Run {
    runner::BackendInfo backend;
    ScreenIndirectSettings settings;
    runner::Precision precision;
    MemoryUse memory;
    Measurement measurement;
};

// Two columns a run. The passes are those of one plan, but a backend that cannot tell has none.
std::string measurementTable(const std::vector<Run>& runs) {
    std::vector<std::string> headings = {"pass"};
    std::vector<TableRow> rows;
    for (const Run& run : runs)
        for (size_t i = rows.size(); i < run.measurement.passes.size(); ++i)
            rows.push_back({run.measurement.passes[i].name, {}});
    rows.push_back({"frame", {}});
    for (const Run& run : runs) {
        const std::string prefix = runs.size() > 1 ? run.backend.backend + " " : "";
        headings.push_back(prefix + "median [ms]");
        headings.push_back(prefix + "minimum [ms]");
        const std::vector<Series>& passes = run.measurement.passes;
        for (size_t i = 0; i + 1 < rows.size(); ++i)
            for (const double value : {i < passes.size() ? passes[i].median() : NAN,
                                       i < passes.size() ? passes[i].minimum() : NAN})
                rows[i].second.push_back(value);
        rows.back().second.push_back(run.measurement.frame.median());
        rows.back().second.push_back(run.measurement.frame.minimum());
    }
    return toTable(headings, rows);
}

Result<Run> benchOn(Preparation& preparation, const SourcedFrame& source,
                    const ScreenIndirectSettings& settings, const BenchOptions& options) {
    auto pipeline =
        measure::FramePipeline::create(source.frame, settings, *preparation.backend, preparation.precision);
    if (!pipeline) return measure::spelled(pipeline.error(), measure::Spelling::options);
    ProgressLine line("measuring");
    auto measurement = measure::measureFrames(
        *pipeline, {options.warmUp, options.frames, [&line](double share) { line.update(share); }});
    if (!measurement) return measurement.error();
    return Run{preparation.backend->info(), pipeline->settings(), preparation.precision,
               pipeline->memoryUse(), *std::move(measurement)};
}

void print(const SourcedFrame& source, const std::vector<Run>& runs, const BenchOptions& options) {
    const std::string& preset = options.technique.preset;
    if (options.json) {
        std::vector<Json> all;
        for (const Run& run : runs)
            all.push_back(
                toJson(runToJson(source, run.settings, preset, run.backend, run.precision, run.memory),
                       run.measurement, options));
        const Json json = all.size() == 1 ? all[0] : Json{{"runs", all}};
        std::cout << toText(json);
        return;
    }
    for (const Run& run : runs)
        std::cout << describeRun(source, run.settings, preset, run.backend, run.precision);
    std::cout << options.frames << " frames after " << options.warmUp << " to warm up\n\n"
              << measurementTable(runs);
    for (const Run& run : runs)
        if (const Series& recording = run.measurement.recording; !recording.milliseconds.empty())
            std::cout << "\nrecording a frame takes " << run.backend.backend << "'s host "
                      << std::lround(recording.median() * 1000.0) << " microseconds, at least "
                      << std::lround(recording.minimum() * 1000.0);
    for (const Run& run : runs)
        std::cout << "\nmemory " << (runs.size() > 1 ? "of " + run.backend.backend + " " : "")
                  << toText(run.memory);
    std::cout << '\n';
}

Result<> bench(const BenchOptions& options) {
    std::vector<Preparation> preparations;
    for (const std::string& backend : splitList(options.device.backend)) {
        DeviceChoice choice = options.device;
        choice.backend = backend;
        if (backend == "cpu" && options.device.backend != "cpu") choice.device.clear(); // it means the others
        auto preparation = prepare(options.technique, choice);
        if (!preparation) return preparation.error();
        preparations.push_back(*std::move(preparation));
    }
    if (preparations.empty())
        return invalidArgument("--backend is empty; some of cpu, vulkan and opengl were expected");
    const auto source = obtainFrame(options.source, preparations[0].extent, options.device.threads);
    if (!source) return source.error();
    const auto settings = settingsOf(options.technique, source->frame.depth.extent());
    if (!settings) return settings.error();
    std::vector<Run> runs;
    for (Preparation& preparation : preparations) {
        auto run = benchOn(preparation, *source, *settings, options);
        if (!run) return run.error();
        runs.push_back(*std::move(run));
    }
    print(*source, runs, options);
    printNotes(source->notes, options.json ? std::cerr : std::cout);
    return {};
}

} // namespace

Command addBenchCommand(CLI::App& program) {
    auto options = std::make_shared<BenchOptions>();
    CLI::App* app = program.add_subcommand("bench", "measure the milliseconds of every pass");
    addSourceOptions(*app, options->source);
    addTechniqueOptions(*app, options->technique);
    addDeviceOptions(*app, options->device);
    excludeSceneOptionsFromFrames(*app);
    app->get_option("--backend")
        ->description("what the technique runs on: cpu, vulkan or opengl, or several with commas\n"
                      "between them (default: cpu)");
    app->add_option("--frames", options->frames, "frames to measure, 1 to 100000 (default: 50)")
        ->option_text("N")
        ->check(CLI::Range(1, 100000))
        ->group("Measurement");
    app->add_option("--warm-up", options->warmUp, "frames to run before, 0 to 100000 (default: 5)")
        ->option_text("N")
        ->check(CLI::Range(0, 100000))
        ->group("Measurement");
    app->add_flag("--json", options->json, "print JSON, and nothing else, on standard output")
        ->group("Measurement");
    app->footer(
        "Prints the median and the minimum of every pass and of the whole frame. Loading the scene and\n"
        "rendering its G-buffer are not in them; reading and writing the host's images is.\n"
        "\n"
        "Examples:\n"
        "  rebound bench\n"
        "  rebound bench --size 1920x1080 --preset half-64 --threads 1 --isa scalar --frames 20\n"
        "  rebound bench --json > quarter-64.json\n"
        "  rebound bench --backend cpu,vulkan,opengl");
    return [options] { return exitCodeOf(bench(*options)); };
}

} // namespace rebound::cli
