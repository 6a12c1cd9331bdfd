// SPDX-License-Identifier: MIT
// One primitive of a glTF mesh in the mesh's own space.
#pragma once

#include "lab/gltf/gltf_materials.hpp"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

namespace rebound::lab {

struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // as stored; empty: the file has none
    std::vector<glm::vec4> colors;  // COLOR_0, 0 to 1; empty: the file has none
    // Transformed by the material's mapping; empty: the base colour has no texture.
    std::vector<glm::vec2> textureCoordinates;
    std::vector<glm::vec2> emissionCoordinates; // likewise of the emission; empty too where they are the same
    std::vector<uint32_t> indices;              // three a triangle, all in range
};

// Whether it is a list, strip or fan of triangles, with positions.
bool hasTriangles(const tinygltf::Primitive&);

// The number of vertices, without reading them.
size_t vertexCount(const tinygltf::Model&, const tinygltf::Primitive&);

// Morph targets are added by their weights. A textured primitive without texture coordinates gets zeros.
// Throws InputError.
Primitive readPrimitive(const tinygltf::Model&, const tinygltf::Primitive&, const GltfMaterial&,
                        const std::vector<double>& morphWeights);

} // namespace rebound::lab
