// SPDX-License-Identifier: MIT
#include "lab/scenes/scene_files.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_file.hpp"
#include "lab/gltf/gltf_meshes.hpp"
#include "lab/gltf/gltf_nodes.hpp"
#include "lab/gltf/gltf_textures.hpp"
#include "lab/gltf/gltf_views.hpp"

namespace rebound::lab {

Result<Scene> loadGltf(const std::filesystem::path& file, const GltfOptions& options) {
    const auto read = [&] {
        const tinygltf::Model model = readGltfFile(file);
        std::vector<NodePose> poses = restPose(model);
        applyAnimation(model, options, poses);
        std::vector<glm::dmat4> world = worldMatrices(model, poses);
        moveNodes(model, options.moved, world);
        const std::vector<int> nodes = sceneNodes(model);

        Scene scene;
        scene.name = file.stem().string();
        GltfTextures textures(model, file);
        GltfGeometry geometry = readGeometry(model, nodes, poses, world, textures);
        scene.meshes = std::move(geometry.meshes);
        scene.materials = std::move(geometry.materials);
        scene.textures = textures.take();
        scene.cameras = readCameras(model, nodes, world);
        scene.lights = readLights(model, nodes, world);
        if (const Result<> valid = validate(scene); !valid) refuse(valid.error().message);
        return scene;
    };
    return guardInput(file, read);
}

} // namespace rebound::lab
