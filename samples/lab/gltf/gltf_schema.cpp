// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_schema.hpp"

#include "lab/files/input_error.hpp"
#include "lab/files/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

namespace rebound::lab {
namespace {

using Json = nlohmann::json;

enum class Type { any, object, objects, text, boolean, number, whole, numbers };

struct Key;

// A table of keys; none by default.
struct Keys {
    constexpr Keys() = default;
    template <size_t size>
    constexpr Keys(const Key (&table)[size]) : first(table), count(size) {}
    const Key* begin() const { return first; }
    const Key* end() const;

    const Key* first = nullptr;
    size_t count = 0;
};

struct Key {
    const char* name;
    Type type = Type::any;
    bool required = false;
    size_t count = 0; // of numbers; 0: any
    Keys keys = {};   // of an object, or of each of a list of objects
};

const Key* Keys::end() const { return first + count; }

constexpr bool required = true, optional = false;

constexpr Key name = {"name", Type::text};

constexpr Key sparseIndices[] = {{"bufferView", Type::any, required},
                                 {"byteOffset", Type::whole},
                                 {"componentType", Type::whole, required}};
constexpr Key sparseValues[] = {{"bufferView", Type::any, required}, {"byteOffset", Type::whole}};
constexpr Key sparse[] = {{"count", Type::number, required},
                          {"indices", Type::object, required, 0, sparseIndices},
                          {"values", Type::object, required, 0, sparseValues}};
constexpr Key accessor[] = {{"byteOffset", Type::whole},
                            {"componentType", Type::whole, required},
                            {"normalized", Type::boolean},
                            {"count", Type::whole, required},
                            {"type", Type::text, required},
                            {"sparse", Type::object, optional, 0, sparse},
                            name};

constexpr Key target[] = {{"path", Type::text, required}};
constexpr Key channel[] = {{"sampler", Type::any, required}, {"target", Type::object, required, 0, target}};
constexpr Key animationSampler[] = {
    {"input", Type::any, required}, {"output", Type::any, required}, {"interpolation", Type::text}};
constexpr Key animation[] = {{"channels", Type::objects, required, 0, channel},
                             {"samplers", Type::objects, required, 0, animationSampler},
                             name};

constexpr Key bufferView[] = {{"byteStride", Type::whole}, name};

constexpr Key perspective[] = {{"yfov", Type::number, required},
                               {"znear", Type::number, required},
                               {"zfar", Type::number},
                               {"aspectRatio", Type::number}};
constexpr Key orthographic[] = {{"xmag", Type::number, required},
                                {"ymag", Type::number, required},
                                {"zfar", Type::number, required},
                                {"znear", Type::number, required}};
constexpr Key camera[] = {{"type", Type::text, required},
                          {"perspective", Type::object, optional, 0, perspective},
                          {"orthographic", Type::object, optional, 0, orthographic},
                          name};

constexpr Key image[] = {{"uri", Type::text}, {"mimeType", Type::text}, name};

constexpr Key textureInfo[] = {{"index", Type::any, required}};
constexpr Key surface[] = {{"baseColorFactor", Type::numbers, optional, 4},
                           {"baseColorTexture", Type::object, optional, 0, textureInfo},
                           {"metallicFactor", Type::number},
                           {"roughnessFactor", Type::number},
                           {"metallicRoughnessTexture", Type::object, optional, 0, textureInfo}};
constexpr Key material[] = {{"pbrMetallicRoughness", Type::object, optional, 0, surface},
                            {"normalTexture", Type::object, optional, 0, textureInfo},
                            {"occlusionTexture", Type::object, optional, 0, textureInfo},
                            {"emissiveTexture", Type::object, optional, 0, textureInfo},
                            {"emissiveFactor", Type::numbers, optional, 3},
                            {"alphaMode", Type::text},
                            {"alphaCutoff", Type::number},
                            {"doubleSided", Type::boolean},
                            name};

constexpr Key primitive[] = {
    {"attributes", Type::object, required}, {"mode", Type::whole}, {"targets", Type::objects}};
constexpr Key mesh[] = {
    {"primitives", Type::objects, required, 0, primitive}, {"weights", Type::numbers}, name};

constexpr Key node[] = {{"matrix", Type::numbers, optional, 16},
                        {"rotation", Type::numbers, optional, 4},
                        {"scale", Type::numbers, optional, 3},
                        {"translation", Type::numbers, optional, 3},
                        {"weights", Type::numbers},
                        name};

constexpr Key sampler[] = {{"magFilter", Type::whole},
                           {"minFilter", Type::whole},
                           {"wrapS", Type::whole},
                           {"wrapT", Type::whole},
                           name};
constexpr Key scene[] = {name};
constexpr Key skin[] = {{"joints", Type::any, required}, name};
constexpr Key texture[] = {name};

constexpr Key spot[] = {{"innerConeAngle", Type::number}, {"outerConeAngle", Type::number}};
constexpr Key light[] = {
    {"type", Type::text, required}, {"color", Type::numbers, optional, 3},     {"intensity", Type::number},
    {"range", Type::number},        {"spot", Type::object, optional, 0, spot}, name};
constexpr Key lights[] = {{"lights", Type::objects, required, 0, light}};
constexpr Key extensions[] = {{"KHR_lights_punctual", Type::object, optional, 0, lights}};

constexpr Key asset[] = {{"version", Type::text, required}, {"minVersion", Type::text}};

constexpr Key root[] = {{"asset", Type::object, required, 0, asset},
                        {"accessors", Type::objects, optional, 0, accessor},
                        {"animations", Type::objects, optional, 0, animation},
                        {"bufferViews", Type::objects, optional, 0, bufferView},
                        {"cameras", Type::objects, optional, 0, camera},
                        {"images", Type::objects, optional, 0, image},
                        {"materials", Type::objects, optional, 0, material},
                        {"meshes", Type::objects, optional, 0, mesh},
                        {"nodes", Type::objects, optional, 0, node},
                        {"samplers", Type::objects, optional, 0, sampler},
                        {"scenes", Type::objects, optional, 0, scene},
                        {"skins", Type::objects, optional, 0, skin},
                        {"textures", Type::objects, optional, 0, texture},
                        {"extensions", Type::object, optional, 0, extensions}};

bool isNumber(const Json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

bool isOf(const Json& value, const Key& key) {
    switch (key.type) {
    case Type::any:
        return true;
    case Type::object:
        return value.is_object();
    case Type::objects:
        return value.is_array() &&
               std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_object(); });
    case Type::text:
        return value.is_string();
    case Type::boolean:
        return value.is_boolean();
    case Type::number:
        return isNumber(value);
    case Type::whole:
        return value.is_number_unsigned();
    case Type::numbers:
        return value.is_array() && (key.count == 0 || value.size() == key.count) &&
               std::all_of(value.begin(), value.end(), isNumber);
    }
    return false;
}

std::string expectation(const Key& key) {
    switch (key.type) {
    case Type::any:
        return "a value";
    case Type::object:
        return "an object";
    case Type::objects:
        return "a list of objects";
    case Type::text:
        return "a string";
    case Type::boolean:
        return "true or false";
    case Type::number:
        return "a finite number";
    case Type::whole:
        return "a whole number that is not negative";
    case Type::numbers:
        return key.count == 0 ? "a list of finite numbers" : std::to_string(key.count) + " finite numbers";
    }
    return {};
}

void check(const Json& object, const Keys& keys, const std::string& path) {
    for (const Key& key : keys) {
        const std::string place = path.empty() ? key.name : path + "." + key.name;
        const auto found = object.find(key.name);
        if (found == object.end()) {
            if (key.required) refuse("the key '" + place + "' is missing; expected " + expectation(key));
            continue;
        }
        if (!isOf(*found, key))
            refuse("the key '" + place + "' is " + shown(*found) + "; expected " + expectation(key));
        if (key.type == Type::object) check(*found, key.keys, place);
        if (key.type == Type::objects)
            for (size_t i = 0; i < found->size(); ++i)
                check((*found)[i], key.keys, place + "[" + std::to_string(i) + "]");
    }
}

void checkAccessorTypes(const Json& gltf) {
    constexpr std::string_view types[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    size_t number = 0;
    for (const Json& item : gltf.value("accessors", Json::array())) {
        const std::string subject = "accessor " + std::to_string(number++);
        const auto& type = item.at("type").get_ref<const std::string&>();
        if (std::find(std::begin(types), std::end(types), type) == std::end(types))
            refuse(subject + " has the type " + shown(item.at("type")) +
                   "; expected SCALAR, VEC2 to VEC4 or MAT2 to MAT4");
        const uint64_t component = item.at("componentType").get<uint64_t>();
        constexpr uint64_t byte = 5120, single = 5126;
        if (component < byte || component > single)
            refuse(subject + " has the component type " + std::to_string(component) +
                   ", which glTF does not know");
    }
}

void checkStrides(const Json& gltf) {
    size_t number = 0;
    for (const Json& item : gltf.value("bufferViews", Json::array())) {
        const std::string subject = "buffer view " + std::to_string(number++);
        if (!item.contains("byteStride")) continue;
        const uint64_t stride = item.at("byteStride").get<uint64_t>();
        constexpr uint64_t unit = 4, most = 252;
        if (stride < unit || stride > most || stride % unit != 0)
            refuse(subject + " has a stride of " + std::to_string(stride) +
                   " bytes; expected a multiple of 4 up to 252");
    }
}

// References that tinygltf follows before the lab does.
void checkReferences(const Json& gltf) {
    const auto countOf = [&](const char* list) { return gltf.contains(list) ? gltf.at(list).size() : 0; };
    const auto require = [](const std::string& subject, const Json& index, size_t count, const char* what) {
        if (index >= count)
            refuse(subject + " refers to " + what + " " + shown(index) + ", but the file has " +
                   std::to_string(count));
    };
    size_t number = 0;
    for (const Json& item : gltf.value("images", Json::array())) {
        const std::string subject = "image " + std::to_string(number++);
        if (item.contains("bufferView"))
            require(subject, item.at("bufferView"), countOf("bufferViews"), "buffer view");
    }
    number = 0;
    for (const Json& item : gltf.value("meshes", Json::array())) {
        const std::string subject = "mesh " + std::to_string(number++);
        for (const Json& part : item.at("primitives")) {
            if (!part.contains("indices")) continue;
            require(subject, part.at("indices"), countOf("accessors"), "accessor");
        }
    }
    number = 0;
    for (const Json& item : gltf.value("accessors", Json::array())) {
        const std::string subject = "accessor " + std::to_string(number++);
        if (item.contains("bufferView"))
            require(subject, item.at("bufferView"), countOf("bufferViews"), "buffer view");
    }
}

// What is one of two things, and has the part that belongs to it.
void checkAlternatives(const Json& gltf) {
    size_t number = 0;
    for (const Json& item : gltf.value("cameras", Json::array())) {
        const std::string subject = "camera " + std::to_string(number++);
        const std::string type = item.at("type").get<std::string>();
        if (type != "perspective" && type != "orthographic")
            refuse(subject + " has the type " + shown(item.at("type")) +
                   "; expected perspective or orthographic");
        if (!item.contains(type)) refuse(subject + " is " + type + ", but lacks the key '" + type + "'");
    }
    number = 0;
    for (const Json& item : gltf.value("images", Json::array())) {
        const std::string subject = "image " + std::to_string(number++);
        if (item.contains("uri") == item.contains("bufferView"))
            refuse(subject + " has " + (item.contains("uri") ? "both" : "neither") +
                   " of the keys 'uri' and 'bufferView'; expected one of them");
    }
    number = 0;
    const Json::json_pointer list("/extensions/KHR_lights_punctual/lights");
    for (const Json& item : gltf.contains(list) ? gltf.at(list) : Json::array()) {
        const std::string subject = "light " + std::to_string(number++);
        if (item.at("type") == "spot" && !item.contains("spot"))
            refuse(subject + " is a spot light, but lacks the key 'spot'");
    }
}

} // namespace

void checkGltfSchema(const Json& gltf) {
    check(gltf, root, {});
    checkAlternatives(gltf);
    checkAccessorTypes(gltf);
    checkStrides(gltf);
    checkReferences(gltf);
}

} // namespace rebound::lab
