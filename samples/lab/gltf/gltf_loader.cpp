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
        GltfNotes notes;
        const tinygltf::Model model = readGltfFile(file, notes);
        std::vector<NodePose> poses = restPose(model);
        applyAnimation(model, options, poses, notes);
        std::vector<glm::dmat4> world = worldMatrices(model, poses);
        moveNodes(model, options.moved, world);
        const std::vector<int> nodes = sceneNodes(model);
        const std::vector<int> visible = visibleNodes(model, nodes);

        Scene scene;
        scene.name = file.stem().string();
        GltfTextures textures(model, file, notes);
        GltfGeometry geometry = readGeometry(model, visible, poses, world, textures, notes);
        scene.meshes = std::move(geometry.meshes);
        scene.materials = std::move(geometry.materials);
        scene.textures = textures.take();
        scene.cameras = readCameras(model, nodes, world);
        scene.lights = readLights(model, visible, world, notes);
        scene.notes = notes.take(file.string());
        if (const Result<> valid = validate(scene); !valid) refuse(valid.error().message);
        return scene;
    };
    return guardInput(file, read);
}

} // namespace rebound::lab
