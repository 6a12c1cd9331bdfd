// SPDX-License-Identifier: MIT
// A glTF file's images, decoded as materials ask for them.
#pragma once

#include "lab/gltf/gltf_notes.hpp"
#include "lab/scenes/scene.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <tuple>
#include <vector>

namespace rebound::lab {

// Pictures are refused beyond these sizes.
inline constexpr int largestTextureSide = 16384;               // [texels]
inline constexpr size_t largestTextureSize = size_t(1) << 26;  // [texels]
inline constexpr size_t largestTextureTotal = size_t(1) << 28; // of all textures of a file together [texels]

class GltfTextures {
public:
    GltfTextures(const tinygltf::Model& gltf, std::filesystem::path gltfFile, GltfNotes& gltfNotes)
        : model(gltf), file(std::move(gltfFile)), notes(gltfNotes) {}

    // The index into list() of a texture of the file, decoded on its first use. PNG and JPEG; 16-bit
    // channels are cut to 8. Filters other than bilinear are noted. Throws InputError.
    int use(int gltfTexture);

    const std::vector<Texture>& list() const { return textures; }
    std::vector<Texture> take() { return std::move(textures); }

private:
    const tinygltf::Model& model;
    std::filesystem::path file;
    GltfNotes& notes;
    std::vector<Texture> textures;
    std::map<std::tuple<int, Wrap, Wrap>, int> indices; // by image and wrapping
    size_t total = 0;                                   // [texels]
};

} // namespace rebound::lab
