// SPDX-License-Identifier: MIT
#include "lab/scenes/scene_builder.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace rebound::lab {

int SceneBuilder::texture(Texture made) {
    scene.textures.push_back(std::move(made));
    return static_cast<int>(scene.textures.size()) - 1;
}

MeshBuilder& SceneBuilder::surface(const std::string& name, const glm::vec3& reflectance, int texture,
                                   float repeats) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(reflectance, 1.0f);
    material.baseColorTexture = texture;
    scene.materials.push_back(material);
    return meshes.emplace_back(name, static_cast<int>(scene.materials.size()) - 1, repeats);
}

MeshBuilder& SceneBuilder::object(const std::string& name, const std::string& surface) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const Material& material) { return material.name == surface; });
    return meshes.emplace_back(name, static_cast<int>(found - scene.materials.begin()));
}

void SceneBuilder::camera(const std::string& name, const glm::vec3& position, const glm::vec3& target,
                          float degrees, float nearPlane, float farPlane) {
    CameraView camera;
    camera.name = name;
    camera.position = position;
    camera.target = target;
    camera.verticalFieldOfView = glm::radians(degrees);
    camera.nearPlane = nearPlane;
    camera.farPlane = farPlane;
    scene.cameras.push_back(camera);
}

Scene SceneBuilder::take() {
    for (MeshBuilder& mesh : meshes)
        if (Mesh made = mesh.take(); !made.indices.empty()) scene.meshes.push_back(std::move(made));
    return std::move(scene);
}

glm::mat4 placedAt(const glm::vec3& position, float degrees) {
    return glm::rotate(glm::translate(glm::mat4(1.0f), position), glm::radians(degrees), glm::vec3(0, 1, 0));
}

Light makeSun(const glm::vec3& direction, const glm::vec3& irradiance) {
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    sun.direction = glm::normalize(direction);
    sun.intensity = irradiance;
    return sun;
}

} // namespace rebound::lab
