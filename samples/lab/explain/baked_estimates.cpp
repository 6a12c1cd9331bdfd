// SPDX-License-Identifier: MIT
#include "lab/explain/baked_estimates.hpp"

#include "lab/baking/surfel_lookup.hpp"
#include "lab/images/luminance.hpp"
#include "lab/light/path_walk.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/rays/parallel_rows.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::explain {

namespace {

using lab::Image;
using lab::Reflector;
using lab::SurfacePoint;

class Estimator {
public:
    Estimator(const lab::EmbreeScene& embree, const lab::CameraView& view, const lab::LitBake& lit,
              const std::vector<glm::vec3>& radiances, const EstimateOptions& given)
        : scene(embree), camera(view), baked(lit), sent(radiances), options(given), rays(view, given.extent),
          light(embree), lookup(lit.bake) {
        const Image black(given.extent, 3);
        estimates = {black, black, black, Image(given.extent, 1)};
    }

    BakedEstimates run() {
        lab::parallelRows(options.extent.height, options.threads, options.progress, [this](int y) {
            for (int x = 0; x < options.extent.width; ++x) estimatePixel(x, y);
        });
        return std::move(estimates);
    }

private:
    struct Sums {
        glm::vec3 fromSurfels{0.0f}, exactDirect{0.0f}, all{0.0f};
        double squared = 0.0; // luminance of all, path by path
    };

    // What a path brings after the first surface that it met, apart: what that surface reflects of direct light.
    struct Recorder {
        glm::vec3 direct{0.0f}, later{0.0f};
        void add(int bounces, glm::vec3 radiance) { (bounces == 0 ? direct : later) += radiance; }
        bool enter(int, const Reflector&) { return true; }
    };

    glm::vec3 directOn(uint32_t surfel) const {
        const size_t stride = BakeLayout::stride(baked.bake.layout.surfels);
        return {baked.direct[surfel], baked.direct[stride + surfel], baked.direct[2 * stride + surfel]};
    }

    // Of what a surfel sends, the part that came to it from other surfaces.
    glm::vec3 sentIndirect(uint32_t index) const {
        const Surfel& surfel = lookup.all()[index];
        const glm::vec3 own =
            surfel.albedo * directOn(index) + (baked.emission ? surfel.emission : glm::vec3(0.0f));
        return glm::max(sent[index] - own, 0.0f);
    }

    void addPath(const SurfacePoint& receiver, lab::SampleSequence sequence, Sums& sums) const {
        const glm::vec3 direction = lab::cosineDirection(receiver.shadingNormal, sequence.next());
        if (lab::receivedCosine(receiver, direction) == 0.0f) return;
        const auto hit =
            scene.locate({receiver.position + receiver.geometricNormal * receiver.clearance, direction});
        if (!hit) return;
        const Reflector sender = reflectorAt(scene, *hit, direction);
        const SurfacePoint& point = sender.point;
        Recorder path;
        path.add(0, light.fromPoints(sender) + light.sentEmission(point));
        lab::walkPath({scene, light, lab::GlossyModel::diffuseOnly, options.bounces - 1}, sender, sequence,
                      path);
        const glm::vec3 all = path.direct + path.later;
        sums.all += all;
        sums.squared += std::pow(double(lab::luminance(all)), 2.0);
        // Where no surfel is near, the surface's own light stands for it.
        const auto surfel = lookup.nearest(point.position, point.geometricNormal);
        sums.fromSurfels += surfel ? sent[*surfel] : all;
        sums.exactDirect += surfel ? path.direct + sentIndirect(*surfel) : all;
    }

    void estimatePixel(int x, int y) {
        const auto hit = visibleThrough(scene, camera, rays, x, y);
        if (!hit) return;
        Sums sums;
        const uint32_t seed = pathSeed(x, y);
        for (int i = 0; i < options.samples; ++i)
            addPath(hit->point, lab::SampleSequence(uint32_t(i), seed), sums);
        const auto store = [&](Image& image, glm::vec3 sum) { storeMean(image, x, y, sum, options.samples); };
        store(estimates.fromSurfels, sums.fromSurfels);
        store(estimates.exactDirect, sums.exactDirect);
        store(estimates.allBounces, sums.all);
        *estimates.standardError.at(x, y) =
            standardErrorOf(double(lab::luminance(sums.all)), sums.squared, options.samples);
    }

    const lab::EmbreeScene& scene;
    const lab::CameraView& camera;
    const lab::LitBake& baked;
    const std::vector<glm::vec3>& sent;
    const EstimateOptions& options;
    lab::CameraRays rays;
    lab::LightSampling light;
    lab::SurfelLookup lookup;
    BakedEstimates estimates;
};

} // namespace

Result<BakedEstimates> estimateFromSurfels(const lab::Scene& scene, const lab::CameraView& camera,
                                           const lab::LitBake& baked, const std::vector<glm::vec3>& sent,
                                           const EstimateOptions& options) {
    if (auto valid = validate(options, camera); !valid) return valid.error();
    const auto embree = lab::EmbreeScene::build(scene);
    if (!embree) return embree.error();
    return Estimator(*embree, camera, baked, sent, options).run();
}

} // namespace rebound::explain
