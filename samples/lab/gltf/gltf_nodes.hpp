// SPDX-License-Identifier: MIT
// A glTF file's node hierarchy at one moment. All functions throw InputError.
#pragma once

#include "lab/scenes/scene_files.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <tiny_gltf.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rebound::lab {

struct NodePose {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix; // instead of the three above
    std::vector<double> morphWeights; // of the node's mesh; empty: the mesh's own
};

// Every node as the file states it.
std::vector<NodePose> restPose(const tinygltf::Model&);

// Replaces what a clip animates; see GltfOptions.
void applyAnimation(const tinygltf::Model&, const GltfOptions&, std::vector<NodePose>&);

// From each node's space to the world's. Refuses hierarchies that are not trees.
std::vector<glm::dmat4> worldMatrices(const tinygltf::Model&, const std::vector<NodePose>&);

// Moves the named nodes, and all that is below each, by transforms in world space. Refuses a name that no node has.
void moveNodes(const tinygltf::Model&, const std::map<std::string, glm::mat4>&, std::vector<glm::dmat4>& world);

// The default scene's nodes, parents before children; of a file without scenes, all nodes.
std::vector<int> sceneNodes(const tinygltf::Model&);

// "node 3 ('arm')"
std::string nodeName(const tinygltf::Model&, size_t node);

} // namespace rebound::lab
