// SPDX-License-Identifier: MIT
#include "scene_data.hpp"

namespace rebound::engine {

SceneData sceneDataOf(const lab::Scene& scene) {
    SceneData data;
    for (const lab::Mesh& mesh : scene.meshes) {
        if (mesh.indices.empty()) continue;
        data.parts.push_back({uint32_t(data.indices.size()), uint32_t(mesh.indices.size()),
                              int32_t(data.vertices.size()), size_t(mesh.material)});
        data.indices.insert(data.indices.end(), mesh.indices.begin(), mesh.indices.end());
        for (size_t i = 0; i < mesh.positions.size(); ++i)
            data.vertices.push_back(
                {mesh.positions[i], mesh.normals[i],
                 mesh.textureCoordinates.empty() ? glm::vec2(0.0f) : mesh.textureCoordinates[i]});
    }
    for (const lab::Material& m : scene.materials) {
        const glm::vec3 emission = scene.emissiveMaterialsLight ? m.emission : glm::vec3(0.0f);
        data.materials.push_back({m.baseColor, {emission, m.alphaMasked ? m.alphaCutoff : -1.0f}});
    }
    return data;
}

} // namespace rebound::engine
