// SPDX-License-Identifier: MIT
#include "lab/baking/scene_geometry.hpp"

#include <algorithm>
#include <vector>

namespace rebound::lab {

namespace {

// Where triangles of the whole lie in their meshes.
struct TriangleOrigins {
    std::vector<uint32_t> firstTriangles; // by mesh

    SurfaceLocation locate(uint32_t triangle, glm::vec2 barycentrics) const {
        const auto after = std::upper_bound(firstTriangles.begin(), firstTriangles.end(), triangle);
        const uint32_t mesh = uint32_t(after - firstTriangles.begin()) - 1;
        return {mesh, triangle - firstTriangles[mesh], barycentrics.x, barycentrics.y};
    }
};

BakeSurface surfaceAt(const EmbreeScene& scene, const SurfaceLocation& location) {
    if (scene.isHole(location)) return {{}, {}, true};
    // What a surface is made of does not depend on where it is seen from.
    const SurfacePoint point = scene.surfaceAt(location, {0, 0, -1});
    return {point.albedo, point.emission, false};
}

} // namespace

std::vector<uint32_t> firstTrianglesOf(const Scene& scene) {
    std::vector<uint32_t> first;
    uint32_t triangles = 0;
    for (const Mesh& mesh : scene.meshes) {
        first.push_back(triangles);
        triangles += uint32_t(mesh.indices.size() / 3);
    }
    return first;
}

BakeGeometry geometryOf(std::shared_ptr<const EmbreeScene> scene) {
    BakeGeometry geometry;
    const TriangleOrigins origins{firstTrianglesOf(scene->scene())};
    for (const Mesh& mesh : scene->scene().meshes) {
        const uint32_t firstVertex = uint32_t(geometry.positions.size());
        geometry.positions.insert(geometry.positions.end(), mesh.positions.begin(), mesh.positions.end());
        for (const uint32_t index : mesh.indices) geometry.indices.push_back(firstVertex + index);
    }
    geometry.mayHaveHoles = [scene, origins](uint32_t triangle) {
        return scene->materialAt(origins.locate(triangle, {})).alphaMasked;
    };
    geometry.surface = [scene = std::move(scene), origins](uint32_t triangle, glm::vec2 barycentrics) {
        return surfaceAt(*scene, origins.locate(triangle, barycentrics));
    };
    return geometry;
}

} // namespace rebound::lab
