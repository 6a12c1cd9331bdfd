// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_scene.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_file.hpp"
#include "lab/gltf/gltf_meshes.hpp"
#include "lab/gltf/gltf_nodes.hpp"
#include "lab/gltf/gltf_views.hpp"

#include <utility>

namespace rebound::lab {

struct GltfScene::File {
    explicit File(const std::filesystem::path& gltfFile)
        : path(gltfFile), model(readGltfFile(gltfFile, notes)), materials(model, gltfFile, notes) {}

    std::filesystem::path path;
    GltfNotes notes; // of the file, its materials and its textures
    tinygltf::Model model;
    GltfMaterials materials;

    Scene at(const GltfOptions& options) {
        GltfNotes ofMoment;
        std::vector<NodePose> poses = restPose(model);
        applyAnimation(model, options, poses, ofMoment);
        std::vector<glm::dmat4> world = worldMatrices(model, poses);
        moveNodes(model, options.moved, world);
        const std::vector<int> nodes = sceneNodes(model);
        const std::vector<int> visible = visibleNodes(model, nodes);

        Scene scene;
        scene.name = path.stem().string();
        scene.meshes = readMeshes(model, visible, poses, world, materials, ofMoment);
        scene.cameras = readCameras(model, nodes, world);
        scene.lights = readLights(model, visible, world, ofMoment);
        GltfNotes all = notes;
        all.add(ofMoment);
        scene.notes = all.take(path.string());
        return scene;
    }

    static Scene valid(Scene scene) {
        if (const Result<> valid = validate(scene); !valid) refuse(valid.error().message);
        return scene;
    }
};

GltfScene::GltfScene(std::unique_ptr<File> f) : file(std::move(f)) {}
GltfScene::GltfScene(GltfScene&&) noexcept = default;
GltfScene& GltfScene::operator=(GltfScene&&) noexcept = default;
GltfScene::~GltfScene() = default;

Result<GltfScene> GltfScene::open(const std::filesystem::path& path) {
    auto file = guardInput(path, [&] { return std::make_unique<File>(path); });
    if (!file) return file.error();
    return GltfScene(*std::move(file));
}

Result<Scene> GltfScene::at(const GltfOptions& options) & {
    return guardInput(file->path, [&] {
        Scene scene = file->at(options);
        scene.materials = file->materials.list();
        scene.textures = file->materials.textures();
        return File::valid(std::move(scene));
    });
}

Result<Scene> GltfScene::at(const GltfOptions& options) && {
    return guardInput(file->path, [&] {
        Scene scene = file->at(options);
        scene.materials = file->materials.list();
        scene.textures = file->materials.takeTextures();
        return File::valid(std::move(scene));
    });
}

Result<Scene> loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
    auto scene = GltfScene::open(path);
    if (!scene) return scene.error();
    return std::move(*scene).at(options);
}

} // namespace rebound::lab
