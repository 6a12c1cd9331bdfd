// SPDX-License-Identifier: MIT
// A scene on the GPU: one vertex and one index buffer, textures, lights.
#pragma once

#include "objects.hpp"

#include "lab/engine/moment.hpp"
#include "lab/engine/scene_data.hpp"

namespace rebound::engine {

class GpuScene {
public:
    static Result<GpuScene> create(const lab::Scene&);

    // Draws everything with the program in use, which includes shaders/material.glsl.
    void draw() const;

    // From the next frame on.
    void set(const Moment&);

    LightSetup lights;
    Buffer lightBuffer;

private:
    void addMeshes(SceneData);
    void addTextures(const lab::Scene&);

    VertexArray vertexArray;
    Buffer vertices, indices;
    std::vector<SceneData::Part> parts;
    std::vector<MaterialConstants> constants; // by material
    glm::vec3 moved{0.0f};                    // of parts that move
    struct MaterialTextures {
        GLuint baseColor, emission;
    };
    std::vector<MaterialTextures> materialTextures; // by material
    std::vector<Texture> textures;
};

} // namespace rebound::engine
