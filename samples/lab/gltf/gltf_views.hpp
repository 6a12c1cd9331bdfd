// SPDX-License-Identifier: MIT
// A glTF file's cameras and KHR_lights_punctual in world space.
#pragma once

#include "lab/gltf/gltf_notes.hpp"
#include "lab/scenes/scene.hpp"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <vector>

namespace rebound::lab {

// Aspect ratios are left to whoever renders; a camera without a far plane gets CameraView's. Names are made
// unique. Throws InputError.
std::vector<CameraView> readCameras(const tinygltf::Model&, const std::vector<int>& nodes,
                                    const std::vector<glm::dmat4>& world);

// `range` is left out and noted: light falls off with the square of the distance alone. Throws InputError.
std::vector<Light> readLights(const tinygltf::Model&, const std::vector<int>& nodes,
                              const std::vector<glm::dmat4>& world, GltfNotes&);

} // namespace rebound::lab
