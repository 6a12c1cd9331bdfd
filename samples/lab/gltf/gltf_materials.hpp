// SPDX-License-Identifier: MIT
// A glTF file's materials.
#pragma once

#include "lab/gltf/gltf_notes.hpp"
#include "lab/gltf/gltf_textures.hpp"
#include "lab/scenes/scene.hpp"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

namespace rebound::lab {

// How a material finds its texels: a set of texture coordinates and KHR_texture_transform.
struct TextureMapping {
    int set = none; // n of TEXCOORD_n; none: the material has no texture
    glm::mat3 transform{1.0f};

    bool operator==(const TextureMapping&) const = default;
};

struct GltfMaterial {
    Material material;
    TextureMapping colorMapping;    // of the base colour
    TextureMapping emissionMapping; // of the emission
};

// An index of none gives glTF's default material. The alpha mode BLEND is taken for a mask that cuts at half opacity, as
// light passes through nothing that is half there. Metallic and roughness are the factors, without their texture. Notes
// what is left out. Throws InputError.
GltfMaterial readMaterial(const tinygltf::Model&, int material, GltfTextures&, GltfNotes&);

// A file's materials, read as meshes ask for them, each once.
class GltfMaterials {
public:
    // The model and the notes have to outlive it.
    GltfMaterials(const tinygltf::Model& gltf, const std::filesystem::path& file, GltfNotes& gltfNotes)
        : model(gltf), notes(gltfNotes), pictures(gltf, file, gltfNotes) {}

    struct Used {
        int number = 0; // index into list()
        const GltfMaterial& material;
    };
    // By the file's index, or none. Throws InputError.
    Used use(int material);

    const std::vector<Material>& list() const { return materials; }
    const std::vector<Texture>& textures() const { return pictures.list(); }
    std::vector<Texture> takeTextures() { return pictures.take(); }

private:
    const tinygltf::Model& model;
    GltfNotes& notes;
    GltfTextures pictures;
    std::vector<Material> materials;
    std::map<int, std::pair<int, GltfMaterial>> known; // by the file's index
};

} // namespace rebound::lab
