// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "frame_pipeline.hpp"
#include "frame_source.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
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

// What one pass took, or a whole frame, over all measured frames [ms].
struct Series {
    std::string name;
    std::vector<double> milliseconds;

    double minimum() const { return *std::min_element(milliseconds.begin(), milliseconds.end()); }
    double median() const {
        std::vector<double> sorted = milliseconds;
        std::sort(sorted.begin(), sorted.end());
        const size_t middle = sorted.size() / 2;
        return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2.0;
    }
};

struct Measurement {
    std::vector<Series> passes;
    Series frame{"frame", {}};
};

void add(Measurement& measurement, const std::vector<PassTiming>& timings, double frameMilliseconds) {
    if (measurement.passes.empty())
        for (const PassTiming& pass : timings)
            measurement.passes.push_back({pass.label, {}});
    for (size_t i = 0; i < timings.size(); ++i)
        measurement.passes[i].milliseconds.push_back(timings[i].milliseconds);
    measurement.frame.milliseconds.push_back(frameMilliseconds);
}

Result<Measurement> measure(FramePipeline& pipeline, int warmUp, int frames) {
    Measurement measurement;
    ProgressLine line("measuring");
    for (int i = 0; i < warmUp + frames; ++i) {
        const auto milliseconds = pipeline.run();
        if (!milliseconds)
            return milliseconds.error();
        if (i >= warmUp)
            add(measurement, pipeline.timings(), *milliseconds);
        line.update(double(i + 1) / double(warmUp + frames));
    }
    return measurement;
}

Json toJson(Json json, const Measurement& measurement, const BenchOptions& options) {
    json["frames"] = options.frames;
    json["warm_up"] = options.warmUp;
    json["passes"] = Json::array();
    for (const Series& pass : measurement.passes)
        json["passes"].push_back(
            {{"name", pass.name}, {"median_ms", pass.median()}, {"minimum_ms", pass.minimum()}});
    json["frame"] = {{"median_ms", measurement.frame.median()}, {"minimum_ms", measurement.frame.minimum()}};
    return json;
}

std::string measurementTable(const Measurement& measurement) {
    std::vector<TableRow> rows;
    for (const Series& pass : measurement.passes)
        rows.push_back({pass.name, {pass.median(), pass.minimum()}});
    rows.push_back({measurement.frame.name, {measurement.frame.median(), measurement.frame.minimum()}});
    return toTable({"pass", "median [ms]", "minimum [ms]"}, rows);
}

Result<> bench(const BenchOptions& options) {
    auto preparation = prepare(options.technique, options.device);
    if (!preparation)
        return preparation.error();
    const auto source = obtainFrame(options.source, preparation->extent, options.device.threads);
    if (!source)
        return source.error();
    const auto settings = settingsOf(options.technique, source->frame.depth.extent());
    if (!settings)
        return settings.error();
    auto pipeline = FramePipeline::create(source->frame, *settings, *preparation->backend, preparation->precision);
    if (!pipeline)
        return pipeline.error();
    const auto measurement = measure(*pipeline, options.warmUp, options.frames);
    if (!measurement)
        return measurement.error();

    const std::string& preset = options.technique.preset;
    const runner::BackendInfo info = preparation->backend->info();
    if (options.json) {
        const Json run =
            runToJson(*source, pipeline->settings(), preset, info, preparation->precision, pipeline->memoryUse());
        std::cout << toJson(run, *measurement, options).dump(2, ' ', false, Json::error_handler_t::replace)
                  << '\n';
        return {};
    }
    std::cout << describeRun(*source, pipeline->settings(), preset, info, preparation->precision) << options.frames
              << " frames after " << options.warmUp << " to warm up\n\n"
              << measurementTable(*measurement) << "\nmemory " << toText(pipeline->memoryUse()) << '\n';
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
        "  rebound bench --json > quarter-64.json");
    return [options] { return exitCodeOf(bench(*options)); };
}

} // namespace rebound::cli
