// SPDX-License-Identifier: MIT
// Scenes and lights as the sample engines' GPUs take them.
#include "lab/engine/lights.hpp"
#include "lab/engine/scene_data.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace rebound::engine {

TEST_CASE("area lights and emissive triangles become samples of the same power") {
    const lab::Scene box = lab::makeCornellBox();
    const LightSetup lamp = lightsOf(box);
    REQUIRE(lamp.count == 16);
    CHECK(lamp.shadowed == 16);
    float power = 0.0f, area = 0.0f;
    for (const GpuLight& light : lamp.lights) {
        power += light.intensity.x;
        area += light.intensity.w * std::numbers::pi_v<float>;
        CHECK(std::abs(light.position.x) < 0.65f);
    }
    CHECK(power == doctest::Approx(12.0 * 1.3 * 1.05));
    CHECK(area == doctest::Approx(1.3 * 1.05));

    lab::Scene glowing = box;
    glowing.lights.clear();
    glowing.materials[1].emission = {2.0f, 0.0f, 0.0f}; // the left wall
    const LightSetup wall = lightsOf(glowing);
    REQUIRE(wall.count == 64);
    CHECK(wall.shadowed == 0);
    power = 0.0f;
    for (const GpuLight& light : wall.lights) power += light.intensity.x;
    float sum = 0.0f;
    for (const lab::Mesh& mesh : glowing.meshes)
        for (size_t i = 0; mesh.material == 1 && i < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[i]];
            sum += glm::length(
                glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a));
        }
    CHECK(power == doctest::Approx(double(sum))); // twice the half areas
    CHECK(wall.emissionIsDirectLight);
    glowing.emissiveMaterialsLight = false;
    CHECK(lightsOf(glowing).count == 0);
    CHECK_FALSE(lightsOf(glowing).emissionIsDirectLight);
}

TEST_CASE("meshes become draws of one vertex and one index buffer, and materials constants") {
    lab::Scene scene;
    scene.materials.resize(2);
    scene.materials[0].emission = {1.0f, 2.0f, 3.0f};
    scene.materials[1].alphaMasked = true;
    scene.materials[1].alphaCutoff = 0.25f;
    lab::Mesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.normals.assign(3, {0, 0, 1});
    triangle.indices = {2, 0, 1};
    lab::Mesh empty = triangle, second = triangle;
    empty.indices.clear();
    second.material = 1;
    second.textureCoordinates = {{0, 0}, {0.5f, 0}, {0, 0.75f}};
    scene.meshes = {triangle, empty, second};

    SceneData data = sceneDataOf(scene);
    REQUIRE(data.parts.size() == 2); // what is empty is not drawn
    REQUIRE(data.vertices.size() == 6);
    CHECK(data.indices == std::vector<uint32_t>{2, 0, 1, 2, 0, 1}); // relative to the draw's first vertex
    CHECK(data.parts[1].firstIndex == 3);
    CHECK(data.parts[1].indexCount == 3);
    CHECK(data.parts[1].vertexOffset == 3);
    CHECK(data.parts[1].material == 1);
    CHECK(data.vertices[1].textureCoordinate == glm::vec2(0.0f));
    CHECK(data.vertices[5].position == glm::vec3(0, 1, 0));
    CHECK(data.vertices[5].textureCoordinate == glm::vec2(0, 0.75f));
    REQUIRE(data.materials.size() == 2);
    CHECK(data.materials[0].emission == glm::vec4(1, 2, 3, -1)); // no opacity is below -1: no holes
    CHECK(data.materials[1].emission == glm::vec4(0, 0, 0, 0.25f));
    // Surfaces are seen to glow whether or not they are lights.
    scene.emissiveMaterialsLight = false;
    CHECK(sceneDataOf(scene).materials[0].emission == glm::vec4(1, 2, 3, -1));
    // Emission has its own place in its texture where a mesh says so; vertices have a colour, white if none.
    CHECK(data.vertices[5].emissionCoordinate == glm::vec2(0, 0.75f));
    CHECK(data.vertices[5].color == glm::vec4(1.0f));
    scene.meshes[2].emissionCoordinates = {{0, 1}, {1, 0}, {0.25f, 0.5f}};
    scene.meshes[2].colors.assign(3, {0.5f, 0.25f, 0.125f, 1.0f});
    data = sceneDataOf(scene);
    CHECK(data.vertices[5].textureCoordinate == glm::vec2(0, 0.75f));
    CHECK(data.vertices[5].emissionCoordinate == glm::vec2(0.25f, 0.5f));
    CHECK(data.vertices[5].color == glm::vec4(0.5f, 0.25f, 0.125f, 1.0f));
}

} // namespace rebound::engine
