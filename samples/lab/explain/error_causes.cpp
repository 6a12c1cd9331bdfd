// SPDX-License-Identifier: MIT
#include "lab/explain/error_causes.hpp"

#include "lab/explain/screen_estimates.hpp"
#include "lab/runner/runner.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::explain {

namespace {

using lab::Image;

class TechniqueRuns {
public:
    TechniqueRuns(const lab::Frame& source, runner::Backend& device) : frame(source), backend(device) {
        // Light straight from emitters is direct light, of receivers and of senders alike.
        frame.emission = {};
        radiance = lab::outgoingRadiance(frame);
    }

    Result<Image> run(const techniques::Configured& technique) {
        auto inputs = technique.inputs(frame, radiance);
        if (!inputs) return inputs.error();
        auto prepared = backend.prepare(technique.plan, *inputs, {runner::Precision::single, false});
        if (!prepared) return prepared.error();
        if (auto ran = (*prepared)->run(); !ran) return ran.error();
        return (*prepared)->read("indirect");
    }

private:
    lab::Frame frame;
    runner::Backend& backend;
    Image radiance;
};

// Fills in what follows from the difference.
void measure(Cause& cause, const Image& whole, const Image& depth, double truthMean) {
    double sum = 0.0, squared = 0.0, along = 0.0, wholeSquared = 0.0, count = 0.0;
    for (size_t pixel = 0; pixel < depth.data.size(); ++pixel) {
        if (!(depth.data[pixel] > 0.0f)) continue;
        for (size_t c = 0; c < 3; ++c) {
            const double d = double(cause.difference.data[pixel * 3 + c]);
            const double w = double(whole.data[pixel * 3 + c]);
            sum += d;
            squared += d * d;
            along += d * w;
            wholeSquared += w * w;
            count += 1.0;
        }
    }
    if (!(count > 0.0 && truthMean > 0.0)) return;
    cause.bias = sum / count / truthMean;
    cause.rms = std::sqrt(squared / count) / truthMean;
    cause.part = wholeSquared > 0.0 ? along / std::sqrt(wholeSquared * count) / truthMean : 0.0;
}

Image minus(const Image& a, const Image& b) {
    Image difference = a;
    for (size_t i = 0; i < difference.data.size(); ++i) difference.data[i] -= b.data[i];
    return difference;
}

double meanWhereVisible(const Image& image, const Image& depth) {
    double sum = 0.0, count = 0.0;
    for (size_t pixel = 0; pixel < depth.data.size(); ++pixel)
        if (depth.data[pixel] > 0.0f)
            for (size_t c = 0; c < 3; ++c) {
                sum += double(image.data[pixel * 3 + c]);
                count += 1.0;
            }
    return count > 0.0 ? sum / count : 0.0;
}

double noiseOf(const Image& standardError, const Image& depth) {
    double squared = 0.0, count = 0.0;
    for (size_t pixel = 0; pixel < depth.data.size(); ++pixel)
        if (depth.data[pixel] > 0.0f) {
            squared += std::pow(double(standardError.data[pixel]), 2.0);
            count += 1.0;
        }
    return count > 0.0 ? std::sqrt(squared / count) : 0.0;
}

// A result on the way from the technique to the truth, and what was switched to get there.
struct Step {
    std::string name;
    std::string meaning;
    Image image;
};

struct Runs {
    Image result;
    std::vector<Step> steps; // the technique's own approximations
};

// The part of the progress that runs of the technique stand for; sums over all pixels of large pictures take longer.
constexpr double techniqueShare = 0.2;

Result<Runs> runTechnique(const lab::Frame& frame, const ExplainOptions& options) {
    const techniques::View view = techniques::viewOf(frame);
    const auto configured = options.technique->parse(options.draft, view, techniques::Spelling::options);
    if (!configured) return configured.error();
    std::vector<techniques::Ablation> ablations;
    if (options.technique->ablations) {
        auto made = options.technique->ablations(options.draft, view);
        if (!made) return made.error();
        ablations = *std::move(made);
    }
    runner::BackendChoice cpu;
    cpu.threads = options.threads;
    auto backend = runner::createBackend(cpu);
    if (!backend) return backend.error();
    TechniqueRuns technique(frame, **backend);
    const double total = double(ablations.size() + 1);
    const auto progress = [&](size_t done) {
        if (options.progress) options.progress(techniqueShare * double(done) / total);
    };
    auto result = technique.run(*configured);
    if (!result) return result.error();
    progress(1);
    Runs runs{*std::move(result), {}};
    for (const techniques::Ablation& ablation : ablations) {
        auto image = technique.run(ablation.without);
        if (!image) return image.error();
        runs.steps.push_back({ablation.name, ablation.meaning, *std::move(image)});
        progress(runs.steps.size() + 1);
    }
    return runs;
}

Explanation assemble(Runs runs, const techniques::LastApproximation& last, ScreenEstimates screen,
                     const Image& depth) {
    std::vector<Step> steps = std::move(runs.steps);
    steps.push_back({last.name, last.meaning, std::move(screen.withoutVisibility)});
    steps.push_back({"missing visibility", "whatever lies in between -> only senders that the receiver sees",
                     std::move(screen.withVisibility)});
    steps.push_back({"hidden senders",
                     "one depth layer -> senders behind others or turned away, within the view",
                     std::move(screen.inView)});
    steps.push_back({"senders off the screen", "the view -> everything around the receiver",
                     std::move(screen.firstBounce)});
    steps.push_back(
        {"missing bounces", "one bounce -> all that were asked for", std::move(screen.allBounces)});

    Explanation explanation;
    explanation.truth = steps.back().image;
    explanation.truthMean = meanWhereVisible(explanation.truth, depth);
    explanation.whole = {"whole error", "the technique -> the truth", minus(runs.result, explanation.truth)};
    const Image& whole = explanation.whole.difference;
    const Image* before = &runs.result;
    for (const Step& step : steps) {
        Cause cause{step.name, step.meaning, minus(*before, step.image)};
        measure(cause, whole, depth, explanation.truthMean);
        explanation.causes.push_back(std::move(cause));
        before = &step.image;
    }
    Cause directional{"directional resolution",
                      "none: every pixel gathers for its own normal, nothing is kept by direction",
                      Image(depth.extent(), 3)};
    explanation.causes.push_back(std::move(directional));
    measure(explanation.whole, explanation.whole.difference, depth, explanation.truthMean);
    explanation.screenLimit = {"screen-space limit",
                               "all bounces between surfaces that the camera sees -> the truth",
                               minus(screen.screenBounces, explanation.truth)};
    measure(explanation.screenLimit, explanation.screenLimit.difference, depth, explanation.truthMean);
    explanation.noise = noiseOf(screen.standardError, depth) / std::max(explanation.truthMean, 1e-30);
    explanation.result = std::move(runs.result);
    return explanation;
}

} // namespace

Result<Explanation> explainError(const lab::Scene& scene, const lab::CameraView& camera,
                                 const ExplainOptions& options) {
    const Extent2D extent = options.extent;
    const auto frame =
        lab::renderFrame(scene, camera, {.extent = extent, .lightSamples = 64, .threads = options.threads});
    if (!frame) return frame.error();
    auto runs = runTechnique(*frame, options);
    if (!runs) return runs.error();
    const lab::Progress progress = [&](double share) {
        if (options.progress) options.progress(techniqueShare + (1.0 - techniqueShare) * share);
    };
    auto screen = estimateFromScreen(scene, camera,
                                     {extent, options.bounces, options.samples, options.threads, progress});
    if (!screen) return screen.error();
    return assemble(*std::move(runs), options.technique->lastApproximation, *std::move(screen), frame->depth);
}

} // namespace rebound::explain
