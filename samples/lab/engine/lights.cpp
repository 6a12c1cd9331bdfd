// SPDX-License-Identifier: MIT
#include "lights.hpp"

#include "scene_data.hpp"

#include "lab/light/low_discrepancy.hpp"
#include "lab/rays/texture_lookup.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rebound::engine {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
enum Kind { directional, point, spot, surface, twoSidedSurface };

GpuLight disc(glm::vec3 position, glm::vec3 normal, glm::vec3 radiance, float area, Kind kind) {
    return {{position, kind}, {normal, 0.0f}, {radiance * area, area / pi}};
}

void addAreaLight(const lab::Light& light, std::vector<GpuLight>& lights) {
    constexpr int side = 4;
    const glm::vec3 up = glm::cross(light.direction, light.right);
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 at = (glm::vec2(i % side, i / side) + 0.5f) / float(side) - 0.5f;
        lights.push_back(
            disc(light.position + light.right * (at.x * light.size.x) + up * (at.y * light.size.y),
                 light.direction, light.intensity, light.size.x * light.size.y / (side * side), surface));
    }
}

void addLight(const lab::Light& light, std::vector<GpuLight>& lights) {
    switch (light.type) {
    case lab::LightType::directional:
        lights.push_back({{light.position, directional}, {light.direction, 0.0f}, {light.intensity, 0.0f}});
        break;
    case lab::LightType::point:
        lights.push_back({{light.position, point}, {light.direction, 0.0f}, {light.intensity, 0.0f}});
        break;
    case lab::LightType::spot:
        lights.push_back({{light.position, spot},
                          {light.direction, std::cos(light.outerCone)},
                          {light.intensity, std::cos(light.innerCone)}});
        break;
    case lab::LightType::area:
        addAreaLight(light, lights);
        break;
    }
}

struct Emitter {
    glm::vec3 corners[3];
    glm::vec2 coordinates[3]; // of its emission
    const lab::Material* material;
    float area, end; // the sum of powers up to and with this one
};

std::vector<Emitter> emittersOf(const lab::Scene& scene) {
    std::vector<Emitter> emitters;
    float total = 0.0f;
    for (const lab::Mesh& mesh : scene.meshes) {
        const lab::Material& material = scene.materials[size_t(mesh.material)];
        if (!scene.emissiveMaterialsLight || material.emission == glm::vec3(0.0f)) continue;
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            Emitter e{{}, {}, &material, 0.0f, 0.0f};
            for (size_t c = 0; c < 3; ++c) {
                e.corners[c] = mesh.positions[mesh.indices[i + c]];
                e.coordinates[c] = emissionCoordinate(mesh, mesh.indices[i + c]);
            }
            e.area = 0.5f * glm::length(glm::cross(e.corners[1] - e.corners[0], e.corners[2] - e.corners[0]));
            if (!(e.area > 0.0f)) continue;
            total += e.area * (material.emission.x + material.emission.y + material.emission.z);
            e.end = total;
            emitters.push_back(e);
        }
    }
    return emitters;
}

// Points on the emissive triangles; each stands for as much area as makes the sum right.
void addEmissiveSurfaces(const lab::Scene& scene, std::vector<GpuLight>& lights) {
    constexpr uint32_t count = 64;
    const std::vector<Emitter> emitters = emittersOf(scene);
    for (uint32_t i = 0; !emitters.empty() && i < count; ++i) {
        const glm::vec2 square = lab::sobolPoint(i, 1);
        const float total = emitters.back().end, wanted = (float(i) + 0.5f) / float(count) * total;
        auto chosen = std::lower_bound(emitters.begin(), emitters.end(), wanted,
                                       [](const Emitter& e, float x) { return e.end < x; });
        chosen = std::min(chosen, emitters.end() - 1);
        const float root = std::sqrt(square.x), u = root * (1.0f - square.y), v = root * square.y,
                    w = 1.0f - u - v;
        const glm::vec3* c = chosen->corners;
        const glm::vec2* t = chosen->coordinates;
        glm::vec3 radiance = chosen->material->emission;
        const float power = radiance.x + radiance.y + radiance.z; // by area, as it was chosen
        if (chosen->material->emissionTexture != lab::none)
            radiance *= glm::vec3(lab::sampleTexture(
                scene.textures[size_t(chosen->material->emissionTexture)], t[0] * w + t[1] * u + t[2] * v));
        lights.push_back(disc(c[0] * w + c[1] * u + c[2] * v,
                              glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0])), radiance,
                              total / power / float(count), twoSidedSurface));
    }
}

void aimShadowMap(const lab::Scene& scene, const lab::Light& light, LightSetup& setup) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const lab::Mesh& mesh : scene.meshes)
        for (const glm::vec3& p : mesh.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    const glm::vec3 center = 0.5f * (low + high), d = light.direction;
    const float radius = std::max(0.5f * glm::length(high - low), 1e-3f);
    const glm::vec3 up = std::abs(d.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    if (light.type == lab::LightType::directional) {
        setup.shadowMatrix = glm::orthoRH_ZO(-radius, radius, -radius, radius, 0.0f, 2.0f * radius) *
                             glm::lookAtRH(center - d * radius, center, up);
        setup.shadowTexel = 2.0f * radius / shadowMapSize;
        return;
    }
    // What lies farther off the axis than 75 degrees is in no map, and counts as lit.
    const float half = light.type == lab::LightType::spot ? std::min(light.outerCone, 1.309f) : 1.309f;
    const float far = glm::length(light.position - center) + radius;
    setup.shadowPerspective = true;
    setup.shadowTexel = 2.0f * std::tan(half) / shadowMapSize;
    setup.shadowMatrix = glm::perspectiveRH_ZO(2.0f * half, 1.0f, 1e-3f * far, far) *
                         glm::lookAtRH(light.position, light.position + d, up);
}

} // namespace

const lab::Light* shadowCaster(const std::vector<lab::Light>& lights) {
    for (lab::LightType type : {lab::LightType::directional, lab::LightType::spot, lab::LightType::area})
        for (const lab::Light& light : lights)
            if (light.type == type) return &light;
    return nullptr;
}

LightSetup lightsOf(const lab::Scene& scene) { return lightsOf(scene, scene.lights); }

LightSetup lightsOf(const lab::Scene& scene, const std::vector<lab::Light>& lights) {
    LightSetup setup;
    const lab::Light* caster = shadowCaster(lights);
    if (caster) {
        addLight(*caster, setup.lights);
        aimShadowMap(scene, *caster, setup);
    }
    setup.shadowed = int(setup.lights.size());
    for (const lab::Light& light : lights)
        if (&light != caster) addLight(light, setup.lights);
    addEmissiveSurfaces(scene, setup.lights);
    setup.emissionIsDirectLight = scene.emissiveMaterialsLight;
    setup.count = int(setup.lights.size());
    if (setup.lights.empty()) setup.lights.emplace_back(); // a buffer is never empty
    return setup;
}

} // namespace rebound::engine
