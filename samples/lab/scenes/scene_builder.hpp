// SPDX-License-Identifier: MIT
// A scene made in code: a material and its mesh for each surface, and meshes of their own for what moves.
#pragma once

#include "lab/scenes/mesh_builder.hpp"

#include <glm/glm.hpp>

#include <deque>
#include <string>

namespace rebound::lab {

class SceneBuilder {
public:
    explicit SceneBuilder(std::string name) { scene.name = std::move(name); }

    // Returns what Material::baseColorTexture takes.
    int texture(Texture);

    // A surface and its mesh of the same name. `reflectance` times the texture; `repeats`: how often that repeats over a
    // metre.
    MeshBuilder& surface(const std::string& name, const glm::vec3& reflectance, int texture = none,
                         float repeats = 1.0f);

    // A mesh of its own, of a surface that is there already.
    MeshBuilder& object(const std::string& name, const std::string& surface);

    void camera(const std::string& name, const glm::vec3& position, const glm::vec3& target, float degrees,
                float nearPlane, float farPlane);

    // Of a scene that the calls above have filled; lights and environment are set in it directly.
    Scene take();

    Scene scene;

private:
    std::deque<MeshBuilder> meshes; // whose references stay
};

// A rotation about a vertical axis, then a translation.
glm::mat4 placedAt(const glm::vec3& position, float degrees = 0.0f);

Light makeSun(const glm::vec3& direction, const glm::vec3& irradiance);

} // namespace rebound::lab
