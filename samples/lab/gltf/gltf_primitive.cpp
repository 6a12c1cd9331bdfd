// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_primitive.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"

#include <map>
#include <numeric>
#include <string>

namespace rebound::lab {
namespace {

using Attributes = std::map<std::string, int>;

template <int size>
std::vector<glm::vec<size, float>> readVectors(const tinygltf::Model& model, int accessor, size_t expected) {
    const std::vector<float> values = readFloats(model, accessor, size);
    if (values.size() != expected * size)
        refuse("accessor " + std::to_string(accessor) + " has " + std::to_string(values.size() / size) +
               " elements for " + std::to_string(expected) + " vertices");
    std::vector<glm::vec<size, float>> vectors(expected);
    for (size_t i = 0; i < values.size(); ++i)
        vectors[i / size][static_cast<glm::length_t>(i % size)] = values[i];
    return vectors;
}

// A primitive's morph targets and how much each of them counts.
struct Morph {
    const std::vector<Attributes>& targets;
    const std::vector<double>& weights;
};

template <int size>
void addMorphTargets(const tinygltf::Model& model, const Morph& morph, const std::string& semantic,
                     std::vector<glm::vec<size, float>>& vectors) {
    const auto& [targets, weights] = morph;
    for (size_t target = 0; target < targets.size() && target < weights.size(); ++target) {
        const auto found = targets[target].find(semantic);
        if (found == targets[target].end() || weights[target] == 0.0) continue;
        const auto offsets = readVectors<size>(model, found->second, vectors.size());
        for (size_t i = 0; i < vectors.size(); ++i)
            vectors[i] += static_cast<float>(weights[target]) * offsets[i];
    }
}

// glTF has colours of bytes and shorts normalised, all of them clamped, and opaque where they have three components.
std::vector<glm::vec4> readColors(const tinygltf::Model& model, const Attributes& attributes,
                                  const Morph& morph, size_t count) {
    const std::string semantic = "COLOR_0";
    const auto found = attributes.find(semantic);
    if (found == attributes.end()) return {};
    const tinygltf::Accessor& accessor = itemAt(model.accessors, found->second, "accessor");
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !accessor.normalized)
        refuse("accessor " + std::to_string(found->second) +
               " holds colours that are neither floats nor normalised");
    std::vector<glm::vec4> colors;
    if (accessor.type == TINYGLTF_TYPE_VEC3) {
        std::vector<glm::vec3> opaque = readVectors<3>(model, found->second, count);
        addMorphTargets(model, morph, semantic, opaque);
        for (const glm::vec3& color : opaque) colors.emplace_back(color, 1.0f);
    } else {
        colors = readVectors<4>(model, found->second, count);
        addMorphTargets(model, morph, semantic, colors);
    }
    for (glm::vec4& color : colors) color = glm::clamp(color, 0.0f, 1.0f);
    return colors;
}

std::vector<glm::vec2> readTextureCoordinates(const tinygltf::Model& model, const Attributes& attributes,
                                              const Morph& morph, const TextureMapping& mapping,
                                              size_t count) {
    if (mapping.set == none) return {};
    const std::string semantic = "TEXCOORD_" + std::to_string(mapping.set);
    const auto found = attributes.find(semantic);
    if (found == attributes.end()) return std::vector<glm::vec2>(count, glm::vec2(0.0f));
    std::vector<glm::vec2> coordinates = readVectors<2>(model, found->second, count);
    addMorphTargets(model, morph, semantic, coordinates);
    for (glm::vec2& v : coordinates) v = glm::vec2(mapping.transform * glm::vec3(v, 1.0f));
    return coordinates;
}

// Strips and fans become lists of the same winding.
std::vector<uint32_t> toTriangleList(const std::vector<uint32_t>& indices, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) return indices;
    std::vector<uint32_t> list;
    list.reserve((indices.size() - 2) * 3);
    for (size_t i = 0; i + 2 < indices.size(); ++i) {
        const size_t odd = i % 2;
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
        else list.insert(list.end(), {indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
    }
    return list;
}

std::vector<uint32_t> readIndices(const tinygltf::Model& model, const tinygltf::Primitive& source,
                                  size_t vertices) {
    std::vector<uint32_t> indices;
    if (source.indices >= 0) {
        indices = readIntegers(model, source.indices, 1);
    } else {
        indices.resize(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    for (const uint32_t index : indices)
        if (index >= vertices)
            refuse("accessor " + std::to_string(source.indices) + " holds the index " +
                   std::to_string(index) + " for " + std::to_string(vertices) + " vertices");
    if (indices.size() < 3 || (source.mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0))
        refuse("a primitive has " + std::to_string(indices.size()) +
               " indices, which are no whole triangles");
    return toTriangleList(indices, source.mode);
}

} // namespace

bool hasTriangles(const tinygltf::Primitive& primitive) {
    const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                           primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    return triangles && primitive.attributes.contains("POSITION");
}

size_t vertexCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    return accessorCount(model, primitive.attributes.at("POSITION"));
}

Primitive readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& source,
                        const GltfMaterial& material, const std::vector<double>& morphWeights) {
    const size_t count = vertexCount(model, source);
    const Morph morph{source.targets, morphWeights};
    Primitive primitive;
    primitive.positions = readVectors<3>(model, source.attributes.at("POSITION"), count);
    addMorphTargets(model, morph, "POSITION", primitive.positions);
    if (const auto normals = source.attributes.find("NORMAL"); normals != source.attributes.end()) {
        primitive.normals = readVectors<3>(model, normals->second, count);
        addMorphTargets(model, morph, "NORMAL", primitive.normals);
    }
    primitive.colors = readColors(model, source.attributes, morph, count);
    primitive.textureCoordinates =
        readTextureCoordinates(model, source.attributes, morph, material.colorMapping, count);
    if (material.emissionMapping != material.colorMapping)
        primitive.emissionCoordinates =
            readTextureCoordinates(model, source.attributes, morph, material.emissionMapping, count);
    primitive.indices = readIndices(model, source, count);
    return primitive;
}

} // namespace rebound::lab
