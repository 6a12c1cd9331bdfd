// SPDX-License-Identifier: MIT
#include "scene_data.hpp"

#include "moment.hpp"

namespace rebound::engine {

SceneData sceneDataOf(const lab::Scene& scene) {
    SceneData data;
    for (const lab::Mesh& mesh : scene.meshes) {
        if (mesh.indices.empty()) continue;
        data.parts.push_back({uint32_t(data.indices.size()), uint32_t(mesh.indices.size()),
                              int32_t(data.vertices.size()), size_t(mesh.material), mesh.name == movingMesh});
        data.indices.insert(data.indices.end(), mesh.indices.begin(), mesh.indices.end());
        for (size_t i = 0; i < mesh.positions.size(); ++i)
            data.vertices.push_back({mesh.positions[i], mesh.normals[i], textureCoordinate(mesh, i),
                                     emissionCoordinate(mesh, i),
                                     mesh.colors.empty() ? glm::vec4(1.0f) : mesh.colors[i]});
    }
    for (const lab::Material& m : scene.materials)
        data.materials.push_back({m.baseColor, {m.emission, m.alphaMasked ? m.alphaCutoff : -1.0f}});
    return data;
}

glm::vec2 textureCoordinate(const lab::Mesh& mesh, size_t vertex) {
    return mesh.textureCoordinates.empty() ? glm::vec2(0.0f) : mesh.textureCoordinates[vertex];
}

glm::vec2 emissionCoordinate(const lab::Mesh& mesh, size_t vertex) {
    return mesh.emissionCoordinates.empty() ? textureCoordinate(mesh, vertex)
                                            : mesh.emissionCoordinates[vertex];
}

} // namespace rebound::engine
