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

constexpr size_t mostRuns = 64; // all of them are held at once

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

// One configuration of the technique on one backend.
struct Run {
    std::string name; // among the runs
    runner::BackendInfo backend;
    runner::Precision precision;
    std::unique_ptr<measure::FramePipeline> pipeline;
    Measurement measurement;
};

// Two columns a run. Precondition: all are of one plan; a backend that cannot tell has no passes.
std::string passTable(const std::vector<Run>& runs) {
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

std::string frameTable(const std::vector<Run>& runs) {
    std::vector<TableRow> rows;
    for (const Run& run : runs)
        rows.push_back({run.name,
                        {run.measurement.frame.median(), run.measurement.frame.minimum(),
                         measure::ratioOf(run.measurement, runs[0].measurement)}});
    return toTable({"frame", "median [ms]", "minimum [ms]", "to the first"}, rows, LastRow::together);
}

// Every combination of what stands between commas.
std::vector<TechniqueOptions> configurationsOf(const TechniqueOptions& options) {
    std::vector<TechniqueOptions> all = {options};
    for (const auto& [option, text] : options.draft) {
        std::vector<std::string> values = splitList(text);
        if (values.empty()) values = {text}; // to be refused by the technique
        std::vector<TechniqueOptions> combined;
        for (const TechniqueOptions& one : all)
            for (const std::string& value : values) {
                combined.push_back(one);
                combined.back().draft[option] = value;
            }
        all = std::move(combined);
        if (all.size() > mostRuns) break;
    }
    return all;
}

Result<std::vector<Run>> prepareRuns(const std::vector<TechniqueOptions>& configurations,
                                     std::vector<Preparation>& preparations, const SourcedFrame& source,
                                     int threads) {
    std::vector<Run> runs;
    for (const TechniqueOptions& options : configurations)
        for (Preparation& preparation : preparations) {
            auto configured = configureFor(source, options, threads);
            if (!configured) return configured.error();
            auto pipeline = measure::FramePipeline::create(source.frame, *std::move(configured),
                                                           *preparation.backend, preparation.precision);
            if (!pipeline) return pipeline.error();
            const runner::BackendInfo backend = preparation.backend->info();
            std::string name = configurations.size() > 1 ? pipeline->technique().name : "";
            if (preparations.size() > 1) name += (name.empty() ? "" : ", ") + backend.backend;
            runs.push_back({name,
                            backend,
                            preparation.precision,
                            std::make_unique<measure::FramePipeline>(*std::move(pipeline)),
                            {}});
        }
    return runs;
}

Result<> measureAll(std::vector<Run>& runs, const BenchOptions& options) {
    std::vector<measure::FramePipeline*> pipelines;
    for (const Run& run : runs) pipelines.push_back(run.pipeline.get());
    ProgressLine line("measuring");
    auto measurements = measure::measureInTurns(
        pipelines, {options.warmUp, options.frames, [&line](double share) { line.update(share); }});
    if (!measurements) return measurements.error();
    for (size_t i = 0; i < runs.size(); ++i) runs[i].measurement = std::move((*measurements)[i]);
    return {};
}

Json toJson(const SourcedFrame& source, const std::vector<Run>& runs, const BenchOptions& options) {
    std::vector<Json> all;
    for (const Run& run : runs) {
        all.push_back(toJson(runToJson(source, run.pipeline->technique(), run.backend, run.precision,
                                       run.pipeline->memoryUse()),
                             run.measurement, options));
        if (runs.size() > 1) {
            all.back()["name"] = run.name;
            all.back()["ratio"] = measure::ratioOf(run.measurement, runs[0].measurement);
        }
    }
    return all.size() == 1 ? all[0] : Json{{"runs", all}};
}

void print(const SourcedFrame& source, const std::vector<Run>& runs, bool hasOnePlan, int frames,
           int warmUp) {
    for (const Run& run : runs)
        std::cout << describeRun(source, run.pipeline->technique(), run.backend, run.precision);
    std::cout << frames << " frames after " << warmUp << " to warm up"
              << (runs.size() > 1 ? ", a frame of each run after the other" : "") << "\n\n";
    if (hasOnePlan) std::cout << passTable(runs) << (runs.size() > 1 ? "\n" : "");
    if (runs.size() > 1) std::cout << frameTable(runs);
    for (const Run& run : runs)
        if (const Series& recording = run.measurement.recording; !recording.milliseconds.empty())
            std::cout << "\nrecording a frame takes " << run.backend.backend << "'s host "
                      << std::lround(recording.median() * 1000.0) << " microseconds, at least "
                      << std::lround(recording.minimum() * 1000.0);
    for (const Run& run : runs)
        std::cout << "\nmemory " << (run.name.empty() ? "" : "of " + run.name + " ")
                  << toText(run.pipeline->memoryUse());
    std::cout << '\n';
}

Result<std::vector<Preparation>> prepareBackends(const std::vector<TechniqueOptions>& configurations,
                                                 const DeviceChoice& device) {
    std::vector<Preparation> preparations;
    for (const std::string& backend : splitList(device.backend)) {
        DeviceChoice choice = device;
        choice.backend = backend;
        if (backend == "cpu" && device.backend != "cpu") choice.device.clear(); // it means the others
        auto preparation = prepare(configurations[0], choice);
        if (!preparation) return preparation.error();
        preparations.push_back(*std::move(preparation));
    }
    if (preparations.empty())
        return invalidArgument("--backend is empty; some of cpu, vulkan and opengl were expected");
    for (const TechniqueOptions& configuration : configurations) // all, before anything long begins
        if (auto valid = configure(configuration, {preparations[0].extent}); !valid) return valid.error();
    return preparations;
}

Result<> bench(const BenchOptions& options) {
    const std::vector<TechniqueOptions> configurations = configurationsOf(options.technique);
    if (configurations.size() > mostRuns)
        return invalidArgument("the options' lists have more than " + std::to_string(mostRuns) +
                               " combinations; fewer were expected");
    auto preparations = prepareBackends(configurations, options.device);
    if (!preparations) return preparations.error();
    const auto source = obtainFrame(options.source, preparations->front().extent, options.device.threads);
    if (!source) return source.error();
    const auto notes = notesOf(*source, options.device.threads);
    if (!notes) return notes.error();
    auto runs = prepareRuns(configurations, *preparations, *source, options.device.threads);
    if (!runs) return runs.error();
    if (auto measured = measureAll(*runs, options); !measured) return measured;
    if (options.json) std::cout << toText(toJson(*source, *runs, options));
    else print(*source, *runs, configurations.size() == 1, options.frames, options.warmUp);
    printNotes(*notes, options.json ? std::cerr : std::cout);
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
        "Options of the technique may hold several values with commas between them: every combination is\n"
        "a run. A frame of each run follows one of the other, and each is told as a ratio to the first.\n"
        "\n"
        "Examples:\n"
        "  rebound bench\n"
        "  rebound bench --size 1920x1080 --preset half-64 --threads 1 --isa scalar --frames 20\n"
        "  rebound bench --json > quarter-64.json\n"
        "  rebound bench --backend cpu,vulkan,opengl\n"
        "  rebound bench --preset quarter-64,half-64 --smooth on,off");
    return [options] { return exitCodeOf(bench(*options)); };
}

} // namespace rebound::cli
