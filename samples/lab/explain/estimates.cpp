// SPDX-License-Identifier: MIT
#include "lab/explain/estimates.hpp"

#include "lab/light/low_discrepancy.hpp"
#include "lab/light/surface_lobes.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::explain {

Result<> validate(const EstimateOptions& options, const lab::CameraView& camera) {
    lab::PathTracerOptions tracing;
    tracing.extent = options.extent;
    tracing.bounces = options.bounces;
    tracing.samples = options.samples;
    tracing.threads = options.threads;
    if (auto valid = lab::validate(tracing); !valid) return valid;
    if (options.bounces < 1) return invalidArgument("path tracer option bounces is 0; expected 1 to 64");
    return lab::validate(camera);
}

std::optional<lab::SurfaceHit> visibleThrough(const lab::EmbreeScene& scene, const lab::CameraView& camera,
                                              const lab::CameraRays& rays, int x, int y) {
    const lab::CameraRay through = rays.throughPixel(x, y);
    return scene.intersect(
        {glm::vec3(through.origin), glm::vec3(through.direction), camera.nearPlane, camera.farPlane});
}

uint32_t pathSeed(int x, int y) { return lab::hashBits(lab::hashBits(uint32_t(x), 3u), uint32_t(y)); }

lab::Reflector reflectorAt(const lab::EmbreeScene& scene, const lab::LocationHit& hit, glm::vec3 direction) {
    const lab::SurfacePoint point = scene.surfaceAt(hit.location, direction);
    return {point, -direction,
            lab::lobesOf(scene.materialAt(hit.location), point.albedo, lab::GlossyModel::diffuseOnly)};
}

void storeMean(lab::Image& image, int x, int y, glm::vec3 sum, int samples) {
    const glm::vec3 mean = sum / float(samples);
    std::copy_n(&mean.x, 3, image.at(x, y));
}

float standardErrorOf(double sum, double squared, int samples) {
    const double count = samples, mean = sum / count;
    return float(std::sqrt(std::max(0.0, squared / count - mean * mean) / std::max(1.0, count - 1.0)));
}

} // namespace rebound::explain
