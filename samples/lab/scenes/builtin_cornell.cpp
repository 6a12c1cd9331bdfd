// SPDX-License-Identifier: MIT
// The box measured at Cornell University in 1985, ten times as large: 5.5 m instead of 55 cm. Reflectances
// are close to the measured spectra's colours.
#include "lab/scenes/scene_files.hpp"

#include "lab/scenes/mesh_builder.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace rebound::lab {
namespace {

constexpr float halfWidth = 2.764f;
constexpr float height = 5.488f;
constexpr float halfDepth = 2.796f;
constexpr float thickness = 0.1f; // of the walls, so that nothing shines through their edges

int addMaterial(Scene& scene, const char* name, const glm::vec3& reflectance) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(reflectance, 1.0f);
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

// From the published coordinates in millimetres, whose x runs to the left and whose z runs into the picture.
glm::vec2 fromPublished(float x, float z) { return {halfWidth - x / 100.0f, halfDepth - z / 100.0f}; }

Mesh makeBlock(const char* name, int material, std::array<glm::vec2, 4> outline, float top) {
    MeshBuilder block(name, material);
    block.prism(outline, 0.0f, top);
    return block.take();
}

Mesh makeWall(const char* name, int material, const glm::vec3& low, const glm::vec3& high) {
    MeshBuilder wall(name, material);
    wall.box(low, high);
    return wall.take();
}

void addRoom(Scene& scene, int white, int red, int green) {
    const float w = halfWidth, d = halfDepth, t = thickness;
    scene.meshes.push_back(makeWall("floor", white, {-w - t, -t, -d - t}, {w + t, 0, d}));
    scene.meshes.push_back(makeWall("ceiling", white, {-w - t, height, -d - t}, {w + t, height + t, d}));
    scene.meshes.push_back(makeWall("back wall", white, {-w - t, 0, -d - t}, {w + t, height, -d}));
    scene.meshes.push_back(makeWall("left wall", red, {-w - t, 0, -d}, {-w, height, d}));
    scene.meshes.push_back(makeWall("right wall", green, {w, 0, -d}, {w + t, height, d}));
}

void addBlocks(Scene& scene, int white) {
    scene.meshes.push_back(makeBlock(
        "short block", white,
        {fromPublished(130, 65), fromPublished(290, 114), fromPublished(240, 272), fromPublished(82, 225)},
        1.65f));
    scene.meshes.push_back(makeBlock(
        "tall block", white,
        {fromPublished(423, 247), fromPublished(472, 406), fromPublished(314, 456), fromPublished(265, 296)},
        3.3f));
}

Light makeLamp() {
    Light lamp;
    lamp.name = "lamp";
    lamp.type = LightType::area;
    lamp.position = {0.0f, height - 0.01f, 0.0f};
    lamp.direction = {0, -1, 0};
    lamp.intensity = glm::vec3(12.0f);
    lamp.right = {1, 0, 0};
    lamp.size = {1.3f, 1.05f};
    return lamp;
}

CameraView makeCamera(const char* name, const glm::vec3& position, const glm::vec3& target, float degrees) {
    CameraView camera;
    camera.name = name;
    camera.position = position;
    camera.target = target;
    camera.verticalFieldOfView = glm::radians(degrees);
    camera.farPlane = 50.0f;
    return camera;
}

} // namespace

Scene makeCornellBox() {
    Scene scene;
    scene.name = "cornell";
    const int white = addMaterial(scene, "white", glm::vec3(0.73f));
    const int red = addMaterial(scene, "red", {0.63f, 0.065f, 0.05f});
    const int green = addMaterial(scene, "green", {0.14f, 0.45f, 0.09f});
    addRoom(scene, white, red, green);
    addBlocks(scene, white);
    scene.lights = {makeLamp()};
    scene.cameras = {makeCamera("front", {0.0f, 2.73f, 10.8f}, {0.0f, 2.73f, 0.0f}, 39.3f),
                     makeCamera("corner", {2.3f, 4.2f, 2.5f}, {-1.2f, 1.2f, -1.6f}, 70.0f)};
    return scene;
}

} // namespace rebound::lab
