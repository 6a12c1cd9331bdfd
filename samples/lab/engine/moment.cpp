// SPDX-License-Identifier: MIT
#include "moment.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>

namespace rebound::engine {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int swingFrames = 120, switchFrames = 40;

lab::Mesh ballMesh(float radius, int material) {
    constexpr uint32_t rings = 24, sectors = 48;
    lab::Mesh mesh;
    mesh.name = movingMesh;
    mesh.material = material;
    for (uint32_t r = 0; r <= rings; ++r)
        for (uint32_t s = 0; s <= sectors; ++s) {
            const float polar = pi * float(r) / float(rings), around = 2.0f * pi * float(s) / float(sectors);
            const glm::vec3 n(std::sin(polar) * std::cos(around), std::cos(polar),
                              std::sin(polar) * std::sin(around));
            mesh.positions.push_back(n * radius);
            mesh.normals.push_back(n);
        }
    for (uint32_t r = 0; r < rings; ++r)
        for (uint32_t s = 0; s < sectors; ++s) {
            const uint32_t i = r * (sectors + 1) + s, below = i + sectors + 1;
            for (uint32_t k : {i, below + 1, below, i, i + 1, below + 1}) mesh.indices.push_back(k);
        }
    return mesh;
}

struct Swing {
    glm::vec3 middle, side;
};
Swing swingOf(const lab::CameraView& view) {
    const glm::vec3 along = view.target - view.position;
    return {view.position + 0.85f * along,
            glm::normalize(glm::cross(along, view.up)) * (0.1f * glm::length(along))};
}

// The shadowed light is turned around the vertical axis through the scene's first camera's target.
lab::Light swung(lab::Light light, const glm::vec3& target, float phase) {
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), 0.35f * std::sin(phase), glm::vec3(0, 1, 0));
    light.position = target + glm::vec3(turn * glm::vec4(light.position - target, 0.0f));
    light.direction = glm::vec3(turn * glm::vec4(light.direction, 0.0f));
    light.right = glm::vec3(turn * glm::vec4(light.right, 0.0f));
    return light;
}

} // namespace

void addBall(lab::Scene& scene) {
    lab::Material material;
    material.name = movingMesh;
    material.baseColor = {0.8f, 0.8f, 0.8f, 1.0f};
    scene.materials.push_back(material);
    const lab::CameraView& view = scene.cameras.at(0);
    const float radius = 0.06f * glm::length(view.target - view.position);
    scene.meshes.push_back(ballMesh(radius, int(scene.materials.size()) - 1));
}

Moment momentOf(const lab::Scene& scene, int frame) {
    const float phase = 2.0f * pi * float(frame % swingFrames) / float(swingFrames);
    const lab::CameraView& view = scene.cameras.at(0);
    const Swing swing = swingOf(view);
    std::vector<lab::Light> lights = scene.lights;
    const lab::Light* caster = shadowCaster(lights);
    const bool isOn = frame / switchFrames % 2 == 0;
    for (lab::Light& light : lights) {
        if (&light == caster) light = swung(light, view.target, phase);
        else if (!isOn) light.intensity = glm::vec3(0.0f);
    }
    return {swing.middle + swing.side * std::sin(phase), lightsOf(scene, lights)};
}

SurfelSources surfelSourcesOf(const LightSetup& setup) {
    SurfelSources result;
    for (int i = 0; i < setup.count; ++i) {
        const GpuLight& light = setup.lights[size_t(i)];
        const int views = i < setup.shadowed ? 1 : 0;
        // GpuLight's kinds and numbers are those of LightSource.
        result.sources.push_back(
            {light.position, light.direction, light.intensity, {int(light.position.w), 0, views, 0}});
    }
    result.view = shadowView(setup.shadowMatrix, {}, {0, {0, 0}, {shadowMapSize, shadowMapSize}});
    return result;
}

} // namespace rebound::engine
