// SPDX-License-Identifier: MIT
// A glTF file's materials.
#pragma once

#include "lab/gltf/gltf_notes.hpp"
#include "lab/gltf/gltf_textures.hpp"
#include "lab/scenes/scene.hpp"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <string>

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

} // namespace rebound::lab
