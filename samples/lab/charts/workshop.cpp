// SPDX-License-Identifier: MIT
#include "lab/charts/workshop.hpp"

#include "lab/light/reference_cache.hpp"
#include "lab/measure/measurement.hpp"
#include "lab/rays/frame_check.hpp"

#include <algorithm>

namespace rebound::charts {

namespace {

lab::PathTracerOptions tracerOptions(const Sweep& sweep) {
    lab::PathTracerOptions options;
    options.extent = sweep.size;
    options.bounces = sweep.reference.bounces;
    options.samples = sweep.reference.samples;
    options.error = sweep.reference.error;
    return options;
}

// A part of a longer step.
lab::Progress partOf(const lab::Progress& whole, double from, double to) {
    return [&whole, from, to](double share) {
        if (whole) whole(from + (to - from) * share);
    };
}

} // namespace

Result<> LabWorkshop::prepareFrame(const View& view, const lab::Progress& progress) {
    if (frameOf == view.label) return {};
    lab::FrameOptions options;
    options.extent = sweep.size;
    options.progress = progress;
    auto rendered = lab::renderFrame(*view.world, view.camera, options);
    if (!rendered) return rendered.error();
    const auto nameOfImage = [&](const char* image) { return "'" + view.scene + "': the rendered " + image; };
    if (auto valid = lab::checkFrame(*rendered, nameOfImage); !valid) return valid;
    frame = *std::move(rendered);
    frameOf = view.label;
    return {};
}

Result<Truth> LabWorkshop::truth(const View& view, const lab::Progress& progress) {
    if (auto prepared = prepareFrame(view, partOf(progress, 0.0, 0.1)); !prepared) return prepared.error();
    lab::PathTracerOptions options = tracerOptions(sweep);
    options.progress = partOf(progress, 0.1, 1.0);
    auto traced = lab::cachedReference(*view.world, view.camera, options, references);
    if (!traced) return traced.error();
    Truth truth;
    truth.light = std::move(traced->indirect);
    truth.halves = std::move(traced->indirectHalves);
    truth.visible = frame.depth;
    truth.direct = lab::outgoingRadiance(frame);
    truth.samples = traced->samples;
    truth.relativeError = traced->relativeError;
    return truth;
}

Result<Trial> LabWorkshop::measure(const View& view, const techniques::Configured& technique,
                                   ChartBackend& backend, const lab::Progress& progress) {
    if (auto prepared = prepareFrame(view, {}); !prepared) return prepared.error();
    auto whole = techniques::completed(technique, {view.world, 0, {}}, view.label);
    if (!whole) return whole.error();
    auto pipeline = measure::FramePipeline::create(frame, *std::move(whole), *backend.backend, precision);
    if (!pipeline) return pipeline.error();
    auto measured =
        measure::measureFrames(*pipeline, {std::max(sweep.warmUp, pipeline->technique().settlingFrames - 1),
                                           sweep.frames, progress});
    if (!measured) return measured.error();
    auto light = pipeline->indirect();
    if (!light) return light.error();
    return Trial{std::move(measured->frame.milliseconds), *std::move(light)};
}

} // namespace rebound::charts
