// SPDX-License-Identifier: MIT
#include "lab/rays/frame.hpp"

#include "lab/light/direct_light.hpp"
#include "lab/light/low_discrepancy.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/rays/embree_scene.hpp"
#include "lab/rays/parallel_rows.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <string>

namespace rebound::lab {

namespace {

constexpr int mostLightSamples = 1 << 16;
constexpr int mostThreads = 1024;

Error outOfRange(const char* option, int value, int least, int most) {
    return invalidArgument(std::string("frame option ") + option + " is " + std::to_string(value) +
                           "; expected " + std::to_string(least) + " to " + std::to_string(most));
}

Result<> validate(const FrameOptions& options) {
    for (const auto& [name, size] :
         {std::pair{"extent.width", options.extent.width}, std::pair{"extent.height", options.extent.height}})
        if (size < 1 || size > maximumExtent) return outOfRange(name, size, 1, maximumExtent);
    if (options.lightSamples < 1 || options.lightSamples > mostLightSamples)
        return outOfRange("lightSamples", options.lightSamples, 1, mostLightSamples);
    if (options.threads < 0 || options.threads > mostThreads)
        return outOfRange("threads", options.threads, 0, mostThreads);
    return {};
}

Result<> validate(const PreviousFrame& previous, const Scene& scene) {
    if (auto valid = validate(previous.camera); !valid) return valid;
    bool fits = previous.positions.size() == scene.meshes.size();
    for (size_t i = 0; fits && i < scene.meshes.size(); ++i)
        fits = previous.positions[i].size() == scene.meshes[i].positions.size();
    if (fits) return {};
    return invalidArgument(
        "frame option previous is of a scene of other meshes; one of the same vertices was expected");
}

void store(Image& image, int x, int y, glm::vec3 value) {
    float* pixel = image.at(x, y);
    pixel[0] = value.x;
    pixel[1] = value.y;
    pixel[2] = value.z;
}

class FrameRenderer {
public:
    FrameRenderer(const EmbreeScene& embreeScene, const CameraView& camera, const FrameOptions& frameOptions)
        : scene(embreeScene), options(frameOptions), rays(camera, options.extent),
          light(scene, options.lightSamples) {
        frame.camera = camera;
        frame.depth = Image(options.extent, 1);
        frame.normal = Image(options.extent, 3);
        frame.albedo = Image(options.extent, 3);
        frame.direct = Image(options.extent, 3);
        if (const PreviousFrame* previous = options.previous) {
            previousRays.emplace(previous->camera, options.extent);
            frame.previousCamera = previous->camera;
            frame.motion = Image(options.extent, 2);
        }
        if (anyEmission()) frame.emission = Image(options.extent, 3);
    }

    Frame render() {
        parallelRows(options.extent.height, options.threads, options.progress,
                     [this](int y) { renderRow(y); });
        const auto& emission = frame.emission.data;
        if (std::all_of(emission.begin(), emission.end(), [](float value) { return value == 0.0f; }))
            frame.emission = {};
        return std::move(frame);
    }

private:
    bool anyEmission() const {
        const Scene& source = scene.scene();
        return source.emissiveMaterialsLight &&
               std::any_of(source.materials.begin(), source.materials.end(),
                           [](const Material& material) { return material.emission != glm::vec3(0.0f); });
    }

    void renderRow(int y) {
        for (int x = 0; x < options.extent.width; ++x) {
            const CameraRay through = rays.throughPixel(x, y);
            // Along a direction that advances by 1 on the viewing axis, a ray's t is depth.
            const Ray ray{glm::vec3(through.origin), glm::vec3(through.direction), frame.camera.nearPlane,
                          frame.camera.farPlane};
            if (const auto hit = scene.intersect(ray)) storeHit(x, y, *hit);
        }
    }

    void storeHit(int x, int y, const SurfaceHit& hit) {
        *frame.depth.at(x, y) = hit.distance;
        store(frame.normal, x, y, hit.point.shadingNormal);
        store(frame.albedo, x, y, hit.point.albedo);
        const uint32_t seed = hashBits(uint32_t(x), uint32_t(y));
        store(frame.direct, x, y, light.irradiance(hit.point, seed) / std::numbers::pi_v<float>);
        if (!frame.emission.empty()) store(frame.emission, x, y, hit.point.emission);
        if (!frame.motion.empty()) storeMotion(frame.motion.at(x, y), hit.point.location);
    }

    // Both places come from the same weights of a triangle's corners, so that what stands still does so to the last bit.
    void storeMotion(float* pixel, const SurfaceLocation& location) const {
        const Mesh& mesh = scene.scene().meshes[location.mesh];
        const auto placeIn = [&](const std::vector<glm::vec3>& positions) {
            const auto corner = [&](size_t i) {
                return glm::dvec3(positions[mesh.indices[size_t(location.triangle) * 3 + i]]);
            };
            const double u = double(location.u), v = double(location.v);
            return (1.0 - u - v) * corner(0) + u * corner(1) + v * corner(2);
        };
        const auto now = rays.pixelOf(placeIn(mesh.positions));
        const auto before = previousRays->pixelOf(placeIn(options.previous->positions[location.mesh]));
        const bool isKnown =
            now && before && std::max(std::abs(before->x), std::abs(before->y)) < double(behindCamera);
        pixel[0] = isKnown ? float(before->x - now->x) : behindCamera;
        pixel[1] = isKnown ? float(before->y - now->y) : behindCamera;
    }

    const EmbreeScene& scene;
    const FrameOptions& options;
    CameraRays rays;
    std::optional<CameraRays> previousRays;
    DirectLight light;
    Frame frame;
};

} // namespace

Result<Frame> renderFrame(const Scene& scene, const CameraView& camera, const FrameOptions& options) {
    if (auto valid = validate(options); !valid) return valid.error();
    if (auto valid = validate(camera); !valid) return valid.error();
    if (options.previous)
        if (auto valid = validate(*options.previous, scene); !valid) return valid.error();
    auto embreeScene = EmbreeScene::build(scene);
    if (!embreeScene) return embreeScene.error();
    try {
        return FrameRenderer(*embreeScene, camera, options).render();
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "out of memory for a frame of " +
                                                 std::to_string(options.extent.width) + " x " +
                                                 std::to_string(options.extent.height) + " pixels"};
    }
}

} // namespace rebound::lab
