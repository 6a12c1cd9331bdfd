// SPDX-License-Identifier: MIT
// Linear blend skinning as in glTF 2.0.
#pragma once

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <cstddef>
#include <vector>

namespace rebound::lab {

// From each vertex's bind space to world space. Weights are scaled to a sum of 1; a vertex without any
// follows the first joint. Throws InputError.
std::vector<glm::dmat4> skinMatrices(const tinygltf::Model&, int skin, const tinygltf::Primitive&,
                                     size_t vertexCount, const std::vector<glm::dmat4>& world);

} // namespace rebound::lab
