// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_materials.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::lab {
namespace {

const tinygltf::Value* member(const tinygltf::Value& object, const std::string& key) {
    return object.Has(key) ? &object.Get(key) : nullptr;
}

// Exporters round; what they meant as 1 may be a little more.
float share(double value, const char* what, const std::string& subject) {
    if (!(value >= 0.0 && value <= 1.001))
        refuse(subject + " has a " + what + " of " + std::to_string(value) + "; expected 0 to 1");
    return static_cast<float>(std::min(value, 1.0));
}

double number(const tinygltf::Value& value, const char* what, const std::string& subject) {
    const double result = value.IsNumber() ? value.GetNumberAsDouble() : NAN;
    if (!std::isfinite(result)) refuse(subject + " has a " + what + " that is not a finite number");
    return result;
}

glm::dvec2 pair(const tinygltf::Value& transform, const char* key, double otherwise,
                const std::string& subject) {
    const tinygltf::Value* values = member(transform, key);
    if (!values) return glm::dvec2(otherwise);
    if (values->ArrayLen() != 2)
        refuse(subject + " has a texture transform whose '" + key + "' is not two numbers");
    return {number(values->Get(0), key, subject), number(values->Get(1), key, subject)};
}

// KHR_texture_transform: translation * rotation * scale.
glm::mat3 textureTransform(const tinygltf::Value& transform, const std::string& subject) {
    const glm::dvec2 offset = pair(transform, "offset", 0.0, subject);
    const glm::dvec2 scale = pair(transform, "scale", 1.0, subject);
    const tinygltf::Value* rotation = member(transform, "rotation");
    const double angle = rotation ? number(*rotation, "rotation", subject) : 0.0;
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dmat3 matrix(c * scale.x, -s * scale.x, 0.0, //
                            s * scale.y, c * scale.y, 0.0,  //
                            offset.x, offset.y, 1.0);
    return glm::mat3(matrix);
}

TextureMapping mappingOf(const tinygltf::TextureInfo& info, const std::string& subject) {
    TextureMapping mapping;
    mapping.set = info.texCoord;
    const auto extension = info.extensions.find("KHR_texture_transform");
    if (extension != info.extensions.end()) {
        mapping.transform = textureTransform(extension->second, subject);
        if (const tinygltf::Value* set = member(extension->second, "texCoord"))
            mapping.set = set->IsInt() ? set->GetNumberAsInt() : none;
    }
    if (mapping.set < 0) refuse(subject + " names no set of texture coordinates");
    return mapping;
}

glm::vec3 emissionOf(const tinygltf::Material& source, const std::string& subject) {
    double strength = 1.0;
    const auto extension = source.extensions.find("KHR_materials_emissive_strength");
    if (extension != source.extensions.end())
        if (const tinygltf::Value* value = member(extension->second, "emissiveStrength"))
            strength = number(*value, "emissive strength", subject);
    glm::vec3 emission{0.0f};
    for (int i = 0; i < 3; ++i) {
        const double radiance = source.emissiveFactor[static_cast<size_t>(i)] * strength;
        emission[i] = static_cast<float>(radiance);
        if (!(radiance >= 0.0) || !std::isfinite(emission[i]))
            refuse(subject + " has an emission that is negative or not finite");
    }
    return emission;
}

Material withoutTextures(const tinygltf::Material& source, const std::string& subject) {
    Material material;
    material.name = source.name;
    const tinygltf::PbrMetallicRoughness& surface = source.pbrMetallicRoughness;
    for (int i = 0; i < 4; ++i)
        material.baseColor[i] =
            share(surface.baseColorFactor[static_cast<size_t>(i)], "base colour", subject);
    material.metallic = share(surface.metallicFactor, "metallic factor", subject);
    material.roughness = share(surface.roughnessFactor, "roughness factor", subject);
    material.emission = emissionOf(source, subject);
    if (source.alphaMode != "OPAQUE" && source.alphaMode != "MASK" && source.alphaMode != "BLEND")
        refuse(subject + " has the alpha mode '" + source.alphaMode + "'; expected OPAQUE, MASK or BLEND");
    constexpr double halfOpacity = 0.5;
    const bool blends = source.alphaMode == "BLEND";
    material.alphaMasked = blends || source.alphaMode == "MASK";
    material.alphaCutoff = static_cast<float>(blends ? halfOpacity : source.alphaCutoff);
    if (!std::isfinite(material.alphaCutoff)) refuse(subject + " has an alpha cutoff that is not finite");
    return material;
}

void noteWhatIsLeftOut(const tinygltf::Material& source, const std::string& subject, GltfNotes& notes) {
    using Kind = GltfNotes::Kind;
    if (source.alphaMode == "BLEND") notes.add(Kind::blend, subject);
    if (source.normalTexture.index >= 0) notes.add(Kind::normalTexture, subject);
    if (source.occlusionTexture.index >= 0) notes.add(Kind::occlusionTexture, subject);
    if (source.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0)
        notes.add(Kind::metallicRoughnessTexture, subject);
}

} // namespace

GltfMaterial readMaterial(const tinygltf::Model& model, int index, GltfTextures& textures, GltfNotes& notes) {
    const tinygltf::Material defaults = [] {
        tinygltf::Material material;
        material.name = "default";
        material.emissiveFactor = {0.0, 0.0, 0.0};
        return material;
    }();
    const tinygltf::Material& source = index == none ? defaults : itemAt(model.materials, index, "material");
    const std::string subject = "material " + std::to_string(index) + " ('" + source.name + "')";
    GltfMaterial result{withoutTextures(source, subject), {}, {}};
    noteWhatIsLeftOut(source, subject, notes);

    const tinygltf::TextureInfo& baseColor = source.pbrMetallicRoughness.baseColorTexture;
    if (baseColor.index >= 0) {
        result.material.baseColorTexture = textures.use(baseColor.index);
        result.colorMapping = mappingOf(baseColor, subject);
    }
    const bool emits = result.material.emission != glm::vec3(0.0f);
    if (emits && source.emissiveTexture.index >= 0) {
        result.material.emissionTexture = textures.use(source.emissiveTexture.index);
        result.emissionMapping = mappingOf(source.emissiveTexture, subject);
    }
    return result;
}

GltfMaterials::Used GltfMaterials::use(int index) {
    auto found = known.find(index);
    if (found == known.end()) {
        GltfMaterial read = readMaterial(model, index, pictures, notes);
        materials.push_back(read.material);
        const int number = static_cast<int>(materials.size()) - 1;
        found = known.emplace(index, std::make_pair(number, std::move(read))).first;
    }
    return {found->second.first, found->second.second};
}

} // namespace rebound::lab
