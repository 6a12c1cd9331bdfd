// SPDX-License-Identifier: MIT
#include "lab/baking/map_places.hpp"

#include "lab/baking/scene_geometry.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/rays/parallel_rows.hpp"

#include <array>
#include <cmath>

namespace rebound::lab {

namespace {

// Of depths of the same surface, whose rays round alike or nearly so; objects that move do so by more.
constexpr float sameDepth = 1e-4f;

class MapLookup {
public:
    MapLookup(const Bake& b, const EmbreeScene& s)
        : bake(b), scene(s), firstTriangles(firstTrianglesOf(s.scene())) {}

    glm::vec2 placeAt(const LocationHit& hit, glm::vec3 direction) const {
        const uint32_t triangle = firstTriangles[hit.location.mesh] + hit.location.triangle;
        const std::span<const uint32_t> corners =
            bake.section(BakeSection::mapCorners).subspan(3 * size_t(triangle), 3);
        if (corners[0] == BakeLayout::notInMap) return glm::vec2(outsideMap);
        const auto place = [&](size_t i) {
            return glm::vec2(corners[i] & 0xffffu, corners[i] >> 16) / float(BakeLayout::mapStepsOfTexel);
        };
        const float u = hit.location.u, v = hit.location.v;
        glm::vec2 result = (1.0f - u - v) * place(0) + u * place(1) + v * place(2);
        if (seesBack(hit.location, direction)) result.y += float(bake.layout.mapBackRow);
        return result;
    }

private:
    bool seesBack(const SurfaceLocation& location, glm::vec3 direction) const {
        const Mesh& mesh = scene.scene().meshes[location.mesh];
        const auto corner = [&](size_t i) {
            return glm::dvec3(mesh.positions[mesh.indices[3 * size_t(location.triangle) + i]]);
        };
        return glm::dot(glm::cross(corner(1) - corner(0), corner(2) - corner(0)), glm::dvec3(direction)) >
               0.0;
    }

    const Bake& bake;
    const EmbreeScene& scene;
    std::vector<uint32_t> firstTriangles;
};

} // namespace

Image mapPlacesOf(const Bake& bake, const EmbreeScene& scene, const Frame& frame, int threads) {
    const Extent2D extent = frame.depth.extent();
    const CameraRays rays(frame.camera, extent);
    const MapLookup lookup(bake, scene);
    Image places(extent, 2);
    parallelRows(extent.height, threads, {}, [&](int y) {
        for (int x = 0; x < extent.width; ++x) {
            places.at(x, y)[0] = places.at(x, y)[1] = outsideMap;
            const float depth = *frame.depth.at(x, y);
            if (!(depth > 0.0f)) continue;
            const CameraRay through = rays.throughPixel(x, y);
            const Ray ray{glm::vec3(through.origin), glm::vec3(through.direction), frame.camera.nearPlane,
                          frame.camera.farPlane};
            const auto hit = scene.locate(ray);
            if (!hit || !(std::abs(hit->distance - depth) <= sameDepth * depth)) continue;
            const glm::vec2 place = lookup.placeAt(*hit, ray.direction);
            places.at(x, y)[0] = place.x;
            places.at(x, y)[1] = place.y;
        }
    });
    return places;
}

} // namespace rebound::lab
