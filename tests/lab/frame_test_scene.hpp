// SPDX-License-Identifier: MIT
// Small scenes for tests of frames.
#pragma once

#include "lab/rays/frame.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace rebound::lab {

inline int addMaterial(Scene& scene, glm::vec3 albedo, glm::vec3 emission = glm::vec3(0.0f)) {
    Material material;
    material.baseColor = glm::vec4(albedo, 1.0f);
    material.emission = emission;
    scene.materials.push_back(material);
    return int(scene.materials.size()) - 1;
}

// A parallelogram centre +- a +- b; its normal is a x b. Texture coordinates run from 0 at -a -b to 1 at +a
// +b.
inline Mesh& addQuad(Scene& scene, glm::vec3 centre, glm::vec3 a, glm::vec3 b, int material = 0) {
    Mesh mesh;
    mesh.material = material;
    mesh.positions = {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
    mesh.normals.assign(4, glm::normalize(glm::cross(a, b)));
    mesh.textureCoordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    return scene.meshes.back();
}

// A closed cube about the origin, from -1 to 1, whose six walls face inwards.
inline void addBox(Scene& scene, int material = 0) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 centre(0.0f), a(0.0f), b(0.0f);
            centre[axis] = side;
            a[(axis + 1) % 3] = -side;
            b[(axis + 2) % 3] = 1.0f;
            addQuad(scene, centre, a, b, material);
        }
}

// Sees a square patch of a plane, seen along `direction` from `distance` before its centre, and nothing else.
inline CameraView patchCamera(glm::vec3 centre, glm::vec3 direction, float distance, float side) {
    CameraView camera;
    camera.name = "patch";
    camera.position = centre - direction * distance;
    camera.target = centre;
    camera.up = std::abs(direction.y) > 0.5f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    camera.orthographic = true;
    camera.orthographicHeight = side;
    camera.nearPlane = distance * 1e-3f;
    camera.farPlane = distance * 10.0f;
    return camera;
}

// A horizontal floor at y = 0 that faces up.
inline Scene floorScene(float halfSize = 100.0f, glm::vec3 albedo = glm::vec3(0.5f)) {
    Scene scene;
    scene.name = "floor";
    addMaterial(scene, albedo);
    addQuad(scene, glm::vec3(0.0f), {0, 0, halfSize}, {halfSize, 0, 0});
    return scene;
}

// Looks straight down on the origin from a height; the image's up is -z.
inline CameraView downCamera(float height = 2.0f, float verticalFieldOfView = 1.0f) {
    CameraView camera;
    camera.name = "down";
    camera.position = {0, height, 0};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, -1};
    camera.verticalFieldOfView = verticalFieldOfView;
    camera.nearPlane = height * 1e-3f;
    camera.farPlane = height * 1e3f;
    return camera;
}

inline Frame rendered(const Scene& scene, const CameraView& camera, FrameOptions options) {
    auto frame = renderFrame(scene, camera, options);
    REQUIRE_MESSAGE(frame, (frame ? "" : frame.error().message));
    return *std::move(frame);
}

inline glm::vec3 colorAt(const Image& image, int x, int y) {
    const float* pixel = image.at(x, y);
    return {pixel[0], pixel[1], pixel[2]};
}

// The world position of a pixel by its depth, as the convention of stored frames states it, for perspective.
inline glm::dvec3 positionAt(const Frame& frame, int x, int y) {
    const CameraView& camera = frame.camera;
    const double width = frame.depth.width;
    const double height = frame.depth.height;
    const glm::dvec3 f = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    const glm::dvec3 r = glm::normalize(glm::cross(f, glm::dvec3(camera.up)));
    const glm::dvec3 u = glm::cross(r, f);
    const double t = std::tan(double(camera.verticalFieldOfView) / 2);
    const double depth = double(*frame.depth.at(x, y));
    return glm::dvec3(camera.position) + depth * (f + r * t * (width / height) * (2 * (x + 0.5) / width - 1) +
                                                  u * t * (1 - 2 * (y + 0.5) / height));
}

// Irradiance from a uniform polygon of radiance 1 that lies wholly above the receiver's plane (Lambert).
template <size_t count>
inline double lambert(const std::array<glm::dvec3, count>& corners, glm::dvec3 position, glm::dvec3 normal) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - position);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % count] - position);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
    }
    return std::abs(sum) / 2;
}

} // namespace rebound::lab
