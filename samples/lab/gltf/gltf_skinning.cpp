// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_skinning.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"

#include <string>

namespace rebound::lab {
namespace {

// World matrix times inverse bind matrix, for every joint.
std::vector<glm::dmat4> jointMatrices(const tinygltf::Model& model, const tinygltf::Skin& skin,
                                      const std::string& name, const std::vector<glm::dmat4>& world) {
    if (skin.joints.empty()) refuse(name + " has no joints");
    std::vector<float> inverseBind;
    if (skin.inverseBindMatrices >= 0) {
        inverseBind = readFloats(model, skin.inverseBindMatrices, 16);
        if (inverseBind.size() / 16 < skin.joints.size())
            refuse(name + " has " + std::to_string(inverseBind.size() / 16) + " inverse bind matrices for " +
                   std::to_string(skin.joints.size()) + " joints");
    }
    std::vector<glm::dmat4> matrices;
    for (size_t joint = 0; joint < skin.joints.size(); ++joint) {
        glm::dmat4 matrix = itemAt(world, skin.joints[joint], "node");
        if (!inverseBind.empty()) {
            glm::dmat4 inverse;
            for (size_t i = 0; i < 16; ++i)
                inverse[static_cast<int>(i / 4)][static_cast<int>(i % 4)] =
                    static_cast<double>(inverseBind[joint * 16 + i]);
            matrix = matrix * inverse;
        }
        matrices.push_back(matrix);
    }
    return matrices;
}

} // namespace

std::vector<glm::dmat4> skinMatrices(const tinygltf::Model& model, int skinIndex,
                                     const tinygltf::Primitive& primitive, size_t vertexCount,
                                     const std::vector<glm::dmat4>& world) {
    const std::string name = "skin " + std::to_string(skinIndex);
    const std::vector<glm::dmat4> joints =
        jointMatrices(model, itemAt(model.skins, skinIndex, "skin"), name, world);
    std::vector<glm::dmat4> matrices(vertexCount, glm::dmat4(0.0));
    std::vector<double> sums(vertexCount, 0.0);
    for (int set = 0;; ++set) {
        const auto jointsOf = primitive.attributes.find("JOINTS_" + std::to_string(set));
        const auto weightsOf = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
        if (jointsOf == primitive.attributes.end() || weightsOf == primitive.attributes.end()) break;
        const std::vector<uint32_t> indices = readIntegers(model, jointsOf->second, 4);
        const std::vector<float> weights = readFloats(model, weightsOf->second, 4);
        if (indices.size() != vertexCount * 4 || weights.size() != vertexCount * 4)
            refuse("a skinned primitive does not have joints and weights for all of its " +
                   std::to_string(vertexCount) + " vertices");
        for (size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] >= joints.size())
                refuse("accessor " + std::to_string(jointsOf->second) + " holds the joint " +
                       std::to_string(indices[i]) + "; " + name + " has " + std::to_string(joints.size()));
            if (weights[i] < 0.0f)
                refuse("accessor " + std::to_string(weightsOf->second) + " holds a negative weight");
            matrices[i / 4] += static_cast<double>(weights[i]) * joints[indices[i]];
            sums[i / 4] += static_cast<double>(weights[i]);
        }
    }
    for (size_t i = 0; i < vertexCount; ++i)
        matrices[i] = sums[i] > 0.0 ? matrices[i] / sums[i] : joints.front();
    return matrices;
}

} // namespace rebound::lab
