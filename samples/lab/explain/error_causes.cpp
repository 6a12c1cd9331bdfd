// SPDX-License-Identifier: MIT
#include "lab/explain/error_causes.hpp"

#include "lab/explain/baked_estimates.hpp"
#include "lab/explain/screen_estimates.hpp"
#include "lab/runner/runner.hpp"
#include "rebound/bake/read_surfel.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace rebound::explain {

namespace {

using lab::Image;

// What a technique gives, and, where it has a bake, what that bake's surfels sent.
struct Run {
    Image image;
    std::vector<glm::vec3> sent;
};

// Radiances of surfels as the technique's nodes hold them: times their area, four numbers each.
std::vector<glm::vec3> sentBy(const Bake& bake, const Image& nodes) {
    std::vector<glm::vec3> sent;
    for (uint32_t i = 0; i < bake.layout.surfels; ++i) {
        const float* node = &nodes.data[size_t(i) * 4];
        sent.push_back(glm::vec3(node[0], node[1], node[2]) / surfelOf(bake, i).area);
    }
    return sent;
}

class TechniqueRuns {
public:
    TechniqueRuns(const lab::Frame& source, const lab::Scene& world, const lab::CameraView& view,
                  int threadCount, runner::Backend& device)
        : frame(source), scene(std::make_shared<const lab::Scene>(world)), name(world.name + " " + view.name),
          threads(threadCount), backend(device), radiance(lab::gatheredRadiance(source)) {}

    Result<techniques::Configured> complete(const techniques::Configured& technique) const {
        return techniques::completed(technique, {scene, threads, {}}, name);
    }

    // Of a completed technique.
    Result<Run> run(const techniques::Configured& technique) {
        auto inputs = technique.inputs(frame, radiance, radiance);
        if (!inputs) return inputs.error();
        auto prepared =
            backend.prepare(technique.plan, *inputs, {runner::Precision::single, technique.bake != nullptr});
        if (!prepared) return prepared.error();
        for (int i = 1; i < technique.settlingFrames; ++i)
            if (auto before = (*prepared)->run(); !before) return before.error();
        Run result;
        if (technique.bake) {
            const auto record = (*prepared)->inspect(nullptr);
            if (!record) return record.error();
            result.sent = sentBy(technique.bake->bake, record->front().front().image);
        } else if (auto ran = (*prepared)->run(); !ran) return ran.error();
        auto image = (*prepared)->read("indirect");
        if (!image) return image.error();
        result.image = *std::move(image);
        return result;
    }

private:
    const lab::Frame& frame;
    std::shared_ptr<const lab::Scene> scene;
    std::string name;
    int threads;
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
    // Of the last of these runs.
    std::shared_ptr<const lab::LitBake> bake;
    std::vector<glm::vec3> sent;
};

// The part of the progress that runs of the technique stand for; sums over all pixels of large pictures take longer.
constexpr double techniqueShare = 0.2;

Result<std::vector<techniques::Ablation>> ablationsOf(const ExplainOptions& options,
                                                      const techniques::View& view) {
    if (!options.technique->ablations) return std::vector<techniques::Ablation>{};
    return options.technique->ablations(options.draft, view);
}

Result<Runs> runTechnique(const lab::Frame& frame, const lab::Scene& scene, const lab::CameraView& camera,
                          const ExplainOptions& options) {
    const techniques::View view = techniques::viewOf(frame);
    const auto configured = options.technique->parse(options.draft, view, techniques::Spelling::options);
    if (!configured) return configured.error();
    const auto ablations = ablationsOf(options, view);
    if (!ablations) return ablations.error();
    runner::BackendChoice cpu;
    cpu.threads = options.threads;
    auto backend = runner::createBackend(cpu);
    if (!backend) return backend.error();
    TechniqueRuns technique(frame, scene, camera, options.threads, **backend);
    const double total = double(ablations->size() + 1);
    double done = 0.0;
    Runs runs;
    const auto run = [&](const techniques::Configured& unfinished) -> Result<Image> {
        const auto completed = technique.complete(unfinished);
        if (!completed) return completed.error();
        auto result = technique.run(*completed);
        if (!result) return result.error();
        runs.bake = completed->bake;
        runs.sent = std::move(result->sent);
        done += 1.0;
        if (options.progress) options.progress(techniqueShare * done / total);
        return std::move(result->image);
    };
    auto result = run(*configured);
    if (!result) return result.error();
    runs.result = *std::move(result);
    for (const techniques::Ablation& ablation : *ablations) {
        auto image = run(ablation.without);
        if (!image) return image.error();
        runs.steps.push_back({ablation.name, ablation.meaning, *std::move(image)});
    }
    return runs;
}

// From the technique's last approximation to the truth.
struct Remainder {
    std::vector<Step> steps;
    Image standardError;                // of the truth's luminance
    std::optional<Image> screenBounces; // of techniques that know the screen alone
};

Result<Remainder> remainderOnScreen(const lab::Scene& scene, const lab::CameraView& camera,
                                    const ExplainOptions& options, const lab::Progress& progress) {
    auto screen = estimateFromScreen(
        scene, camera, {options.extent, options.bounces, options.samples, options.threads, progress});
    if (!screen) return screen.error();
    const techniques::LastApproximation& last = options.technique->lastApproximation;
    Remainder rest;
    rest.steps.push_back({last.name, last.meaning, std::move(screen->withoutVisibility)});
    rest.steps.push_back({"missing visibility",
                          "whatever lies in between -> only senders that the receiver sees",
                          std::move(screen->withVisibility)});
    rest.steps.push_back({"hidden senders",
                          "one depth layer -> senders behind others or turned away, within the view",
                          std::move(screen->inView)});
    rest.steps.push_back({"senders off the screen", "the view -> everything around the receiver",
                          std::move(screen->firstBounce)});
    rest.steps.push_back(
        {"missing bounces", "one bounce -> all that were asked for", std::move(screen->allBounces)});
    rest.standardError = std::move(screen->standardError);
    rest.screenBounces = std::move(screen->screenBounces);
    return rest;
}

Result<Remainder> remainderOfBake(const lab::Scene& scene, const lab::CameraView& camera, const Runs& runs,
                                  const ExplainOptions& options, const lab::Progress& progress) {
    auto baked =
        estimateFromSurfels(scene, camera, *runs.bake, runs.sent,
                            {options.extent, options.bounces, options.samples, options.threads, progress});
    if (!baked) return baked.error();
    const techniques::LastApproximation& last = options.technique->lastApproximation;
    Remainder rest;
    rest.steps.push_back({last.name, last.meaning, std::move(baked->fromSurfels)});
    rest.steps.push_back({"surfels", "a surfel's albedo and direct light -> those where each ray ends",
                          std::move(baked->exactDirect)});
    rest.steps.push_back(
        {"bounces", "light that surfels got from caches -> path-traced light", std::move(baked->allBounces)});
    rest.standardError = std::move(baked->standardError);
    return rest;
}

Explanation assemble(Runs runs, Remainder rest, const Image& depth) {
    std::vector<Step> steps = std::move(runs.steps);
    for (Step& step : rest.steps) steps.push_back(std::move(step));

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
    if (rest.screenBounces) {
        Cause directional{"directional resolution",
                          "none: every pixel gathers for its own normal, nothing is kept by direction",
                          Image(depth.extent(), 3)};
        explanation.causes.push_back(std::move(directional));
    }
    measure(explanation.whole, explanation.whole.difference, depth, explanation.truthMean);
    if (rest.screenBounces) {
        explanation.screenLimit = {"screen-space limit",
                                   "all bounces between surfaces that the camera sees -> the truth",
                                   minus(*rest.screenBounces, explanation.truth)};
        measure(*explanation.screenLimit, explanation.screenLimit->difference, depth, explanation.truthMean);
    }
    explanation.noise = noiseOf(rest.standardError, depth) / std::max(explanation.truthMean, 1e-30);
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
    auto runs = runTechnique(*frame, scene, camera, options);
    if (!runs) return runs.error();
    const lab::Progress progress = [&](double share) {
        if (options.progress) options.progress(techniqueShare + (1.0 - techniqueShare) * share);
    };
    auto rest = runs->bake ? remainderOfBake(scene, camera, *runs, options, progress)
                           : remainderOnScreen(scene, camera, options, progress);
    if (!rest) return rest.error();
    return assemble(*std::move(runs), *std::move(rest), frame->depth);
}

} // namespace rebound::explain
