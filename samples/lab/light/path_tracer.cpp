// SPDX-License-Identifier: MIT
#include "lab/light/path_tracer.hpp"

#include "lab/images/luminance.hpp"
#include "lab/light/path_sums.hpp"
#include "lab/light/path_walk.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/rays/parallel_rows.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>

namespace rebound::lab {

namespace {

constexpr int mostBounces = 64;
constexpr int mostSamples = 1 << 20;
constexpr int mostThreads = 1024;
constexpr int mostSamplesOfPass = 8; // of each replicate

Error outOfRange(const char* option, const std::string& value, const std::string& expected) {
    return invalidArgument(std::string("path tracer option ") + option + " is " + value + "; expected " +
                           expected);
}

// Adds what one path brings to its pixel. Radiance is that of a white surface: irradiance over pi.
struct DiffuseRecorder {
    PathSums::Pixel pixel;
    int replicate;
    int measuredFrom; // bounces whose luminance is told apart by replicate

    void add(int bounces, glm::vec3 radiance) {
        pixel.add(bounces == 0 ? PathSums::direct : PathSums::indirect, replicate, radiance);
        if (bounces == 1) pixel.add(PathSums::firstBounce, replicate, radiance);
        if (bounces >= measuredFrom) pixel.addToReplicate(replicate, luminance(radiance));
    }
    bool enter(int, const Reflector&) { return true; }
};

struct GlossyRecorder {
    PathSums::Pixel pixel;
    int replicate;

    void add(int, glm::vec3 radiance) { pixel.add(PathSums::glossy, replicate, radiance); }
    bool enter(int, const Reflector&) { return true; }
};

} // namespace

Result<> validate(const PathTracerOptions& o) {
    const auto checked = [](const char* name, int value, int least, int most) -> Result<> {
        if (value >= least && value <= most) return {};
        return outOfRange(name, std::to_string(value), std::to_string(least) + " to " + std::to_string(most));
    };
    for (const Result<>& valid :
         {checked("extent.width", o.extent.width, 1, maximumExtent),
          checked("extent.height", o.extent.height, 1, maximumExtent),
          checked("bounces", o.bounces, 0, mostBounces), checked("samples", o.samples, 1, mostSamples),
          checked("threads", o.threads, 0, mostThreads)})
        if (!valid) return valid;
    if (!(o.error >= 0.0 && o.error <= 1.0)) return outOfRange("error", std::to_string(o.error), "0 to 1");
    return {};
}

struct PathTracer::State {
    State(const Scene& scene, const CameraView& view, const PathTracerOptions& given, EmbreeScene built)
        : options(given), camera(view), key(pathTracerKey(scene, view, given)), embree(std::move(built)),
          light(embree), rays(view, given.extent),
          sums(given.extent, given.glossy != GlossyModel::diffuseOnly) {}

    int replicateSamples() const {
        return (options.samples + pathTracerReplicates - 1) / pathTracerReplicates;
    }

    std::optional<SurfaceHit> visibleSurface(int x, int y) const {
        const CameraRay through = rays.throughPixel(x, y);
        return embree.intersect(
            {glm::vec3(through.origin), glm::vec3(through.direction), camera.nearPlane, camera.farPlane});
    }

    void addRow(int y, int count) {
        for (int x = 0; x < options.extent.width; ++x)
            if (const auto hit = visibleSurface(x, y)) {
                const glm::vec3 toViewer = -glm::normalize(glm::vec3(rays.throughPixel(x, y).direction));
                addPixel(x, y, hit->point, toViewer, count);
            }
    }

    void addPixel(int x, int y, const SurfacePoint& point, glm::vec3 toViewer, int count) {
        const Material& material = embree.materialAt(point.location);
        const PathSums::Pixel pixel = sums.at(x, y);
        const uint32_t seed = hashBits(hashBits(options.seed, uint32_t(x)), uint32_t(y));
        pixel.show();
        if (diffuseReflectance(material, point.albedo, options.glossy) != glm::vec3(0.0f) ||
            options.glossy == GlossyModel::diffuseOnly)
            addDiffuse(pixel, {point, toViewer, whiteDiffuse()}, seed, count);
        if (options.glossy != GlossyModel::diffuseOnly)
            addGlossy(pixel, {point, toViewer, specularOf(material, point.albedo, options.glossy)},
                      hashBits(seed, 1u), count);
    }

    // Paths of one kind; recorderOf(replicate) takes in what a path brings.
    template <class RecorderOf>
    void addPaths(const Reflector& start, uint32_t seed, int count, RecorderOf recorderOf) {
        for (int i = done; i < done + count; ++i)
            for (int replicate = 0; replicate < pathTracerReplicates; ++replicate) {
                SampleSequence sequence(uint32_t(i), hashBits(seed, uint32_t(replicate) + 2u));
                walkPath({embree, light, options.glossy, options.bounces}, start, sequence,
                         recorderOf(replicate));
            }
    }

    void addDiffuse(PathSums::Pixel pixel, const Reflector& start, uint32_t seed, int count) {
        if (done == 0) pixel.setExact(PathSums::direct, light.fromPoints(start));
        addPaths(start, seed, count, [&](int replicate) {
            return DiffuseRecorder{pixel, replicate, std::min(1, options.bounces)};
        });
    }

    void addGlossy(PathSums::Pixel pixel, const Reflector& start, uint32_t seed, int count) {
        if (done == 0) pixel.setExact(PathSums::glossy, light.fromPoints(start));
        addPaths(start, seed, count, [&](int replicate) { return GlossyRecorder{pixel, replicate}; });
    }

    Image diffuseAlbedo() const {
        Image albedo(options.extent, 3);
        parallelRows(options.extent.height, options.threads, {}, [&](int y) {
            for (int x = 0; x < options.extent.width; ++x)
                if (const auto hit = visibleSurface(x, y)) {
                    const Material& material = embree.materialAt(hit->point.location);
                    const glm::vec3 value = diffuseReflectance(material, hit->point.albedo, options.glossy);
                    std::copy_n(&value.x, 3, albedo.at(x, y));
                }
        });
        return albedo;
    }

    // How much of the work is likely done when that share of a pass has been added: by samples, or, where an
    // error is to be reached, by the samples that its fall with their square root needs.
    double likelyShare(double samples) const {
        double needed = double(replicateSamples());
        if (options.error > 0.0 && error > 0.0 && done > 0)
            needed = std::min(needed, double(done) * std::pow(error / options.error, 2.0));
        return std::min(1.0, samples / std::max(needed, 1.0));
    }

    PathTracerOptions options;
    CameraView camera;
    std::string key;
    EmbreeScene embree;
    LightSampling light;
    CameraRays rays;
    PathSums sums;
    int done = 0;       // samples of each replicate
    double error = 0.0; // relative, after the last pass
};

PathTracer::PathTracer(std::unique_ptr<State> built) : state(std::move(built)) {}
PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer& PathTracer::operator=(PathTracer&&) noexcept = default;
PathTracer::~PathTracer() = default;

Result<PathTracer> PathTracer::create(const Scene& scene, const CameraView& camera,
                                      const PathTracerOptions& options) {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = validate(camera); !valid) return valid.error();
    auto embree = EmbreeScene::build(scene);
    if (!embree) return embree.error();
    try {
        return PathTracer(std::make_unique<State>(scene, camera, options, *std::move(embree)));
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "out of memory for paths through " +
                                                 std::to_string(options.extent.width) + " x " +
                                                 std::to_string(options.extent.height) + " pixels"};
    }
}

bool PathTracer::isDone() const {
    const bool accurate =
        state->options.error > 0.0 && state->done > 1 && state->error <= state->options.error;
    return state->done >= state->replicateSamples() || accurate;
}

// The first passes are short, so that an error that is reached early ends the work early.
void PathTracer::addPass() {
    const int count =
        std::min({std::max(1, state->done), mostSamplesOfPass, state->replicateSamples() - state->done});
    const Progress progress = [&](double share) {
        if (state->options.progress)
            state->options.progress(state->likelyShare(double(state->done) + share * double(count)));
    };
    parallelRows(state->options.extent.height, state->options.threads, progress,
                 [&](int y) { state->addRow(y, count); });
    state->done += count;
    state->error = state->sums.relativeError(state->done);
}

PathTracedLight PathTracer::light() const {
    PathTracedLight light = state->sums.light(state->done);
    light.samples = samples();
    light.relativeError = state->error;
    light.albedo = state->diffuseAlbedo();
    return light;
}

int PathTracer::samples() const { return state->done * pathTracerReplicates; }

EmbreeScene& PathTracer::embreeScene() { return state->embree; }

std::vector<std::byte> PathTracer::save() const { return state->sums.save(state->key, state->done); }

Result<> PathTracer::restore(std::span<const std::byte> bytes) {
    const auto restored = state->sums.restore(state->key, bytes);
    if (!restored) return restored.error();
    state->done = *restored;
    state->error = state->sums.relativeError(state->done);
    return {};
}

Result<PathTracedLight> tracePaths(const Scene& scene, const CameraView& camera,
                                   const PathTracerOptions& options) {
    auto tracer = PathTracer::create(scene, camera, options);
    if (!tracer) return tracer.error();
    while (!tracer->isDone()) tracer->addPass();
    return tracer->light();
}

} // namespace rebound::lab
