// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_views.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"
#include "lab/gltf/gltf_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace rebound::lab {
namespace {

glm::dvec3 axis(const glm::dmat4& matrix, int column, const std::string& subject) {
    const glm::dvec3 v(matrix[column]);
    const double length = glm::length(v);
    if (!(length > 0.0)) refuse(subject + " has a transform without directions");
    return v / length;
}

void requirePositive(double value, const char* what, const std::string& subject) {
    if (!(value > 0.0) || !std::isfinite(static_cast<float>(value)))
        refuse(subject + " has a " + what + " of " + std::to_string(value) + "; expected a positive number");
}

std::string uniqueName(const std::string& wish, const std::vector<CameraView>& cameras) {
    const auto isTaken = [&](const std::string& name) {
        return std::any_of(cameras.begin(), cameras.end(),
                           [&](const CameraView& camera) { return camera.name == name; });
    };
    const std::string base = wish.empty() ? "camera" : wish;
    if (!isTaken(base)) return base;
    // Of so many numbers one is free.
    size_t number = 2;
    while (isTaken(base + " " + std::to_string(number))) ++number;
    return base + " " + std::to_string(number);
}

void readPerspective(const tinygltf::PerspectiveCamera& source, const std::string& subject,
                     CameraView& camera) {
    requirePositive(source.yfov, "field of view", subject);
    requirePositive(source.znear, "near plane", subject);
    camera.verticalFieldOfView = static_cast<float>(source.yfov);
    camera.nearPlane = static_cast<float>(source.znear);
    if (source.yfov >= std::numbers::pi)
        refuse(subject + " has a field of view of " + std::to_string(source.yfov) +
               "; expected less than pi");
    camera.farPlane = std::max(camera.farPlane, camera.nearPlane * 1000.0f);
    if (source.zfar > 0.0) camera.farPlane = static_cast<float>(source.zfar);
}

void readOrthographic(const tinygltf::OrthographicCamera& source, const std::string& subject,
                      CameraView& camera) {
    requirePositive(std::abs(source.ymag), "height", subject);
    camera.orthographic = true;
    camera.orthographicHeight = static_cast<float>(2.0 * std::abs(source.ymag));
    camera.nearPlane = static_cast<float>(source.znear);
    camera.farPlane = static_cast<float>(source.zfar);
}

CameraView readCamera(const tinygltf::Camera& source, const glm::dmat4& world, const std::string& subject) {
    CameraView camera;
    if (source.type == "perspective") readPerspective(source.perspective, subject, camera);
    else readOrthographic(source.orthographic, subject, camera);
    if (!(camera.nearPlane >= 0.0f) || !(camera.farPlane > camera.nearPlane) ||
        !std::isfinite(camera.farPlane))
        refuse(subject + " has planes that are not in the order 0, near, far");
    camera.position = glm::vec3(world[3]);
    camera.target = glm::vec3(glm::dvec3(world[3]) - axis(world, 2, subject));
    camera.up = glm::vec3(axis(world, 1, subject));
    return camera;
}

glm::vec3 intensityOf(const tinygltf::Light& source, const std::string& subject) {
    if (!source.color.empty() && source.color.size() != 3)
        refuse(subject + " has a colour that is not three numbers");
    glm::vec3 intensity{0.0f};
    for (int i = 0; i < 3; ++i) {
        const double value =
            source.intensity * (source.color.empty() ? 1.0 : source.color[static_cast<size_t>(i)]);
        intensity[i] = static_cast<float>(value);
        if (!(value >= 0.0) || !std::isfinite(intensity[i]))
            refuse(subject + " has an intensity that is negative or not finite");
    }
    return intensity;
}

Light readLight(const tinygltf::Light& source, const glm::dmat4& world, const std::string& subject) {
    Light light;
    light.intensity = intensityOf(source, subject);
    light.position = glm::vec3(world[3]);
    if (source.type == "point") {
        light.type = LightType::point;
        return light;
    }
    light.direction = glm::vec3(-axis(world, 2, subject));
    if (source.type == "directional") return light;
    if (source.type != "spot")
        refuse(subject + " has the type '" + source.type + "'; expected directional, point or spot");
    light.type = LightType::spot;
    const double inner = source.spot.innerConeAngle, outer = source.spot.outerConeAngle;
    // The largest angle is pi / 2, which files hold as the next float.
    if (!(inner >= 0.0 && inner <= outer && outer > 0.0 && outer <= std::numbers::pi / 2 + 1e-6))
        refuse(subject + " has cone angles of " + std::to_string(inner) + " and " + std::to_string(outer) +
               "; expected 0 <= inner <= outer <= pi / 2");
    light.innerCone = static_cast<float>(inner);
    light.outerCone = static_cast<float>(outer);
    return light;
}

} // namespace

std::vector<CameraView> readCameras(const tinygltf::Model& model, const std::vector<int>& nodes,
                                    const std::vector<glm::dmat4>& world) {
    std::vector<CameraView> cameras;
    for (const int number : nodes) {
        const auto i = static_cast<size_t>(number);
        const tinygltf::Node& node = model.nodes[i];
        if (node.camera < 0) continue;
        const tinygltf::Camera& source = itemAt(model.cameras, node.camera, "camera");
        CameraView camera = readCamera(source, world[i], "camera " + std::to_string(node.camera));
        camera.name = uniqueName(source.name.empty() ? node.name : source.name, cameras);
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

std::vector<Light> readLights(const tinygltf::Model& model, const std::vector<int>& nodes,
                              const std::vector<glm::dmat4>& world, GltfNotes& notes) {
    std::vector<Light> lights;
    for (const int number : nodes) {
        const auto i = static_cast<size_t>(number);
        const auto extension = model.nodes[i].extensions.find("KHR_lights_punctual");
        if (extension == model.nodes[i].extensions.end()) continue;
        if (!extension->second.Has("light") || !extension->second.Get("light").IsInt())
            refuse(nodeName(model, i) + " names no light");
        const int index = extension->second.Get("light").GetNumberAsInt();
        const tinygltf::Light& source = itemAt(model.lights, index, "light");
        const std::string subject = "light " + std::to_string(index);
        Light light = readLight(source, world[i], subject);
        const bool hasRange = source.range > 0.0 && std::isfinite(source.range);
        if (hasRange && light.type != LightType::directional) notes.add(GltfNotes::Kind::lightRange, subject);
        light.name = source.name.empty() ? model.nodes[i].name : source.name;
        lights.push_back(std::move(light));
    }
    return lights;
}

} // namespace rebound::lab
