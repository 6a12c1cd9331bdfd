// SPDX-License-Identifier: MIT
// A scene as a GPU takes it: one array of vertices, one of indices, a draw a mesh.
#pragma once

#include "lab/scenes/scene.hpp"

namespace rebound::engine {

struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 textureCoordinate, emissionCoordinate;
    glm::vec4 color; // factor of the base colour
};

// Its twins are in the engines' shaders/material.glsl.
struct MaterialConstants {
    glm::vec4 baseColor, emission;
};
// Behind them: how far a mesh is from where its vertices are, in this frame and in the one before. .xyz [m]
struct ObjectConstants {
    glm::vec4 offset{0.0f}, previousOffset{0.0f};
};

struct SceneData {
    struct Part {
        uint32_t firstIndex, indexCount;
        int32_t vertexOffset;
        size_t material;
        bool moves; // drawn where Moment::offset says
    };
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<Part> parts;
    std::vector<MaterialConstants> materials; // as the scene has them
};

SceneData sceneDataOf(const lab::Scene&);

// Where a vertex finds its base colour and its emission in their textures.
glm::vec2 textureCoordinate(const lab::Mesh&, size_t vertex);
glm::vec2 emissionCoordinate(const lab::Mesh&, size_t vertex);

} // namespace rebound::engine
