// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "frame_source.hpp"
#include "lab/measure/measurement.hpp"
#include "lab/rays/parallel_rows.hpp"
#include "options.hpp"
#include "reference_render.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>
#include <vector>

namespace rebound::cli {

namespace {

struct RaysOptions {
    SourceOptions source;
    std::string size = "320x180";
    int bounces = 4;
    int threads = 0;
    int repeats = 5;
    bool json = false;
};

struct RecordedRay {
    lab::Ray ray;
    bool isShadowRay;
};

// Of the same rays: by the path tracer, and by Embree alone.
struct Rates {
    size_t rays = 0;
    measure::Series traced, alone; // a repetition each

    // By the median.
    double perSecond(const measure::Series& series) const { return 1e3 * double(rays) / series.median(); }
};

double millisecondsOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Casts recorded rays in the order in which they were cast, as Embree's tutorials do: one by one.
void replay(const lab::EmbreeScene& scene, const std::vector<RecordedRay>& rays, int threads) {
    constexpr size_t chunk = 4096;
    const int chunks = int((rays.size() + chunk - 1) / chunk);
    std::atomic<size_t> hits = 0; // so that no query is left out
    lab::parallelRows(chunks, threads, {}, [&](int index) {
        size_t found = 0;
        const size_t first = size_t(index) * chunk;
        for (size_t i = first; i < std::min(first + chunk, rays.size()); ++i)
            found +=
                rays[i].isShadowRay ? scene.occluded(rays[i].ray) : scene.locate(rays[i].ray).has_value();
        hits += found;
    });
}

// A first pass of the path tracer: eight paths a pixel.
Result<double> tracePass(const SourcedView& view, const lab::PathTracerOptions& options,
                         std::vector<RecordedRay>* record) {
    auto tracer = lab::PathTracer::create(view.scene, view.camera, options);
    if (!tracer) return tracer.error();
    if (record)
        tracer->embreeScene().observeRays([record](const lab::Ray& ray, bool isShadowRay) {
            record->push_back({ray, isShadowRay});
        });
    return millisecondsOf([&] { tracer->addPass(); });
}

Result<Rates> measure(const SourcedView& view, lab::PathTracerOptions options, int repeats) {
    std::vector<RecordedRay> rays;
    lab::PathTracerOptions single = options;
    single.threads = 1;
    if (auto recorded = tracePass(view, single, &rays); !recorded) return recorded.error();
    auto scene = lab::EmbreeScene::build(view.scene);
    if (!scene) return scene.error();
    Rates rates;
    rates.rays = rays.size();
    for (int i = 0; i < repeats; ++i) {
        const auto traced = tracePass(view, options, nullptr);
        if (!traced) return traced.error();
        rates.traced.milliseconds.push_back(*traced);
        rates.alone.milliseconds.push_back(millisecondsOf([&] { replay(*scene, rays, options.threads); }));
    }
    return rates;
}

Result<> benchRays(const RaysOptions& options) {
    const auto extent = parseSize(options.size);
    if (!extent) return extent.error();
    ReferenceOptions reference;
    reference.bounces = options.bounces;
    reference.samples = lab::pathTracerReplicates;
    const auto tracing = pathTracerOptionsOf(reference, *extent, options.threads);
    if (!tracing) return tracing.error();
    const auto view = loadView(options.source);
    if (!view) return view.error();
    const auto rates = measure(*view, *tracing, options.repeats);
    if (!rates) return rates.error();
    const double traced = rates->perSecond(rates->traced), alone = rates->perSecond(rates->alone);
    if (options.json) {
        const Json json{
            {"scene", options.source.scene}, {"camera", view->camera.name},     {"rays", rates->rays},
            {"rays_per_second", traced},     {"embree_rays_per_second", alone}, {"ratio", traced / alone}};
        std::cout << toText(json);
    } else {
        std::cout << options.source.scene << ", camera " << view->camera.name << ", " << options.size << ", "
                  << formatted("%d bounces: %.2f million rays\n", options.bounces, double(rates->rays) / 1e6)
                  << formatted("path tracer    %6.2f million rays a second\n", traced / 1e6)
                  << formatted("Embree alone   %6.2f million rays a second, the same rays\n", alone / 1e6)
                  << formatted("ratio          %6.2f\n", traced / alone);
    }
    printNotes(view->scene.notes, options.json ? std::cerr : std::cout);
    return {};
}

} // namespace

Command addRaysCommand(CLI::App& program) {
    auto options = std::make_shared<RaysOptions>();
    CLI::App* app = program.add_subcommand("rays", "measure the path tracer beside Embree alone");
    addSceneOptions(*app, options->source);
    app->add_option("--size", options->size, "of the picture [pixels] (default: 320x180)")
        ->option_text("WxH")
        ->group(referenceGroup);
    app->add_option("--bounces", options->bounces, "0 to 64 (default: 4)")
        ->option_text("N")
        ->group(referenceGroup);
    app->add_option("--threads", options->threads, "1 to 1024; 0: one a core (default: 0)")
        ->option_text("N")
        ->group(deviceGroup);
    app->add_option("--repeats", options->repeats, "of which the median counts, 1 to 1000 (default: 5)")
        ->option_text("N")
        ->check(CLI::Range(1, 1000))
        ->group("Measurement");
    app->add_flag("--json", options->json, "print JSON, and nothing else, on standard output")
        ->group("Measurement");
    app->footer(
        "Traces eight paths a pixel, then casts the very same rays again and does nothing else with them.");
    return [options] { return exitCodeOf(benchRays(*options)); };
}

} // namespace rebound::cli
