// SPDX-License-Identifier: MIT
#include "lab/light/emissive_surfaces.hpp"

#include "lab/light/low_discrepancy.hpp"
#include "lab/rays/texture_lookup.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rebound::lab {

namespace {

// Uniform on the triangle.
SurfaceLocation locate(uint32_t mesh, uint32_t triangle, glm::vec2 square) {
    const float root = std::sqrt(square.x);
    return {mesh, triangle, root * (1.0f - square.y), root * square.y};
}

double areaOf(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* index = &mesh.indices[size_t(triangle) * 3];
    const glm::dvec3 a = mesh.positions[index[0]];
    return 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[index[1]]) - a,
                                        glm::dvec3(mesh.positions[index[2]]) - a));
}

float sum(glm::vec3 v) { return v.x + v.y + v.z; }

// Mean emission over a few points, mixed with the most that the texture can give: where the points miss a
// bright spot, it is still found.
float typicalEmission(const EmbreeScene& scene, uint32_t mesh, uint32_t triangle) {
    const Scene& source = scene.scene();
    const Material& material = source.materials[size_t(source.meshes[mesh].material)];
    if (material.emissionTexture == none) return sum(material.emission);
    constexpr uint32_t points = 16;
    constexpr float safetyShare = 0.1f;
    float mean = 0.0f;
    for (uint32_t i = 0; i < points; ++i)
        mean += sum(
            scene.surfaceAt(locate(mesh, triangle, sobolPoint(i, triangle)), glm::vec3(0, 0, -1)).emission);
    return (1.0f - safetyShare) * mean / float(points) + safetyShare * sum(material.emission);
}

} // namespace

EmissiveSurfaces::EmissiveSurfaces(const EmbreeScene& scene) {
    const Scene& source = scene.scene();
    if (!source.emissiveMaterialsLight) return;
    double total = 0.0;
    for (uint32_t mesh = 0; mesh < source.meshes.size(); ++mesh) {
        if (source.materials[size_t(source.meshes[mesh].material)].emission == glm::vec3(0.0f)) continue;
        for (uint32_t triangle = 0; triangle < source.meshes[mesh].indices.size() / 3; ++triangle) {
            const double area = areaOf(source.meshes[mesh], triangle);
            const float emission = typicalEmission(scene, mesh, triangle);
            if (!(area * double(emission) > 0.0)) continue;
            total += area * double(emission);
            triangles.push_back({mesh, triangle, total, emission});
        }
    }
    for (Triangle& triangle : triangles) {
        triangle.cumulative /= total;
        triangle.density = float(double(triangle.density) / total);
    }
}

SurfaceLocation EmissiveSurfaces::sample(glm::vec2 square) const {
    auto chosen =
        std::upper_bound(triangles.begin(), triangles.end(), double(square.x),
                         [](double x, const Triangle& triangle) { return x < triangle.cumulative; });
    chosen = std::min(chosen, triangles.end() - 1);
    // What is left of the first coordinate within the triangle's share is a coordinate again.
    const double low = chosen == triangles.begin() ? 0.0 : (chosen - 1)->cumulative;
    const double rest = (double(square.x) - low) / (chosen->cumulative - low);
    return locate(chosen->mesh, chosen->triangle, {float(std::clamp(rest, 0.0, 1.0)), square.y});
}

const EmissiveSurfaces::Triangle* EmissiveSurfaces::find(const SurfaceLocation& at) const {
    const auto key = std::tuple(at.mesh, at.triangle);
    const auto found = std::lower_bound(triangles.begin(), triangles.end(), key,
                                        [](const Triangle& triangle, const auto& wanted) {
                                            return std::tuple(triangle.mesh, triangle.triangle) < wanted;
                                        });
    const bool same = found != triangles.end() && std::tuple(found->mesh, found->triangle) == key;
    return same ? &*found : nullptr;
}

float EmissiveSurfaces::density(const SurfaceLocation& at) const {
    const Triangle* triangle = find(at);
    return triangle ? triangle->density : 0.0f;
}

} // namespace rebound::lab
