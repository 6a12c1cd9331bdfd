// SPDX-License-Identifier: MIT
#include "lab/explain/screen_estimates.hpp"

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

enum class Sight {
    seen,
    hidden,  // within the view, but behind something, or with its other side to the camera
    outside, // of the view
};

// What one path brings to the pixel it began at.
struct Gathered {
    glm::vec3 first{0.0f};  // of one bounce
    glm::vec3 later{0.0f};  // of more
    glm::vec3 screen{0.0f}; // of any number, by surfaces that are seen
};

class Estimator {
public:
    Estimator(const lab::EmbreeScene& embree, const lab::CameraView& view, const EstimateOptions& given)
        : scene(embree), camera(view), options(given), rays(view, given.extent), light(embree) {
        const Image black(given.extent, 3);
        estimates = {black, black, black, black, black, black, Image(given.extent, 1)};
    }

    ScreenEstimates run() {
        lab::parallelRows(options.extent.height, options.threads, options.progress, [this](int y) {
            for (int x = 0; x < options.extent.width; ++x) estimatePixel(x, y);
        });
        return std::move(estimates);
    }

private:
    Sight sightOf(const SurfacePoint& point) const {
        const auto projected = rays.project(point.position);
        if (!projected || projected->depth < double(camera.nearPlane) ||
            projected->depth > double(camera.farPlane))
            return Sight::outside;
        const glm::vec3 eye(projected->origin);
        const bool facing = glm::dot(point.geometricNormal, eye - point.position) > 0.0f;
        return facing && scene.visible(point, eye) ? Sight::seen : Sight::hidden;
    }

    // Light that the first surface along a path sends on, with all that came before it.
    Gathered follow(const Reflector& start, bool startIsSeen, lab::SampleSequence& sequence) const {
        struct Recorder {
            const Estimator& estimator;
            Gathered gathered;
            bool isSeen;

            void add(int bounces, glm::vec3 radiance) {
                (bounces == 0 ? gathered.first : gathered.later) += radiance;
                if (isSeen) gathered.screen += radiance;
            }
            bool enter(int, const Reflector& at) {
                isSeen = isSeen && estimator.sightOf(at.point) == Sight::seen;
                return true;
            }
        };
        Recorder recorder{*this, {}, startIsSeen};
        recorder.add(0, light.fromPoints(start) + light.sentEmission(start.point));
        lab::walkPath({scene, light, lab::GlossyModel::diffuseOnly, options.bounces - 1}, start, sequence,
                      recorder);
        return recorder.gathered;
    }

    // Light that seen surfaces behind the first along a ray would send, were nothing in between.
    glm::vec3 behind(lab::Ray ray, float distance, lab::SampleSequence& sequence) const {
        struct Recorder {
            glm::vec3 sum{0.0f};
            void add(int, glm::vec3 radiance) { sum += radiance; }
            bool enter(int, const Reflector&) { return false; }
        } recorder;
        constexpr int mostSurfaces =
            256; // along a ray: more than any scene has but for foliage seen from within
        for (int i = 0; i < mostSurfaces; ++i) {
            // Surfaces nearer to each other than rounding tells apart count as one.
            ray.minimum = distance + std::max(lab::endClearance(distance), 1e-5f);
            const auto hit = scene.locate(ray);
            if (!hit) break;
            distance = hit->distance;
            const Reflector sender = reflectorAt(scene, *hit, ray.direction);
            if (sightOf(sender.point) != Sight::seen) continue;
            recorder.sum += light.fromPoints(sender) + light.sentEmission(sender.point);
            lab::walkPath({scene, light}, sender, sequence, recorder);
        }
        return recorder.sum;
    }

    struct Sums {
        glm::vec3 withoutVisibility{0.0f}, withVisibility{0.0f}, inView{0.0f}, first{0.0f}, all{0.0f},
            screen{0.0f};
        double squared = 0.0; // luminance of all, path by path
    };

    void addPath(const SurfacePoint& receiver, lab::SampleSequence sequence, Sums& sums) const {
        const glm::vec3 direction = lab::cosineDirection(receiver.shadingNormal, sequence.next());
        if (lab::receivedCosine(receiver, direction) == 0.0f) return;
        const lab::Ray ray{receiver.position + receiver.geometricNormal * receiver.clearance, direction};
        const auto hit = scene.locate(ray);
        if (!hit) return;
        const Reflector sender = reflectorAt(scene, *hit, direction);
        const Sight sight = sightOf(sender.point);
        const Gathered gathered = follow(sender, sight == Sight::seen, sequence);
        if (sight == Sight::seen) {
            sums.withoutVisibility += gathered.first;
            sums.withVisibility += gathered.first;
        }
        if (sight != Sight::outside) sums.inView += gathered.first;
        sums.first += gathered.first;
        sums.all += gathered.first + gathered.later;
        sums.squared += std::pow(double(lab::luminance(gathered.first + gathered.later)), 2.0);
        sums.screen += gathered.screen;
        sums.withoutVisibility += behind(ray, hit->distance, sequence);
    }

    void estimatePixel(int x, int y) {
        const auto hit = visibleThrough(scene, camera, rays, x, y);
        if (!hit) return;
        Sums sums;
        const uint32_t seed = pathSeed(x, y);
        for (int i = 0; i < options.samples; ++i)
            addPath(hit->point, lab::SampleSequence(uint32_t(i), seed), sums);
        const auto store = [&](Image& image, glm::vec3 sum) { storeMean(image, x, y, sum, options.samples); };
        store(estimates.withoutVisibility, sums.withoutVisibility);
        store(estimates.withVisibility, sums.withVisibility);
        store(estimates.inView, sums.inView);
        store(estimates.firstBounce, sums.first);
        store(estimates.allBounces, sums.all);
        store(estimates.screenBounces, sums.screen);
        *estimates.standardError.at(x, y) =
            standardErrorOf(double(lab::luminance(sums.all)), sums.squared, options.samples);
    }

    const lab::EmbreeScene& scene;
    const lab::CameraView& camera;
    const EstimateOptions& options;
    lab::CameraRays rays;
    lab::LightSampling light;
    ScreenEstimates estimates;
};

} // namespace

Result<ScreenEstimates> estimateFromScreen(const lab::Scene& scene, const lab::CameraView& camera,
                                           const EstimateOptions& options) {
    if (auto valid = validate(options, camera); !valid) return valid.error();
    const auto embree = lab::EmbreeScene::build(scene);
    if (!embree) return embree.error();
    return Estimator(*embree, camera, options).run();
}

} // namespace rebound::explain
