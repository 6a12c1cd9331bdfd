// SPDX-License-Identifier: MIT
// A glTF file's triangles in world space.
#pragma once

#include "lab/gltf/gltf_materials.hpp"
#include "lab/gltf/gltf_nodes.hpp"
#include "lab/scenes/scene.hpp"

#include <cstddef>
#include <vector>

namespace rebound::lab {

// Scenes are refused beyond these sizes, as few bytes of a file can ask for many copies of a mesh.
inline constexpr size_t largestVertexCount = size_t(1) << 25;
inline constexpr size_t largestTriangleCount = size_t(1) << 25;

// The triangles of the given nodes' meshes, one Mesh a primitive. Morph targets and skins are applied; primitives that are
// no triangles are noted. A vertex without skin weights follows the skin's first joint. Throws InputError.
std::vector<Mesh> readMeshes(const tinygltf::Model&, const std::vector<int>& nodes,
                             const std::vector<NodePose>&, const std::vector<glm::dmat4>& world,
                             GltfMaterials&, GltfNotes&);

} // namespace rebound::lab
