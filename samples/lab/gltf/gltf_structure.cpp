// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_structure.hpp"

#include "lab/files/input_error.hpp"
#include "lab/files/json_text.hpp"
#include "lab/gltf/gltf_file.hpp"
#include "lab/gltf/gltf_schema.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string_view>

namespace rebound::lab {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 13> listNames = {
    "accessors", "animations", "buffers",  "bufferViews", "cameras", "images",  "materials",
    "meshes",    "nodes",      "samplers", "scenes",      "skins",   "textures"};

constexpr std::array<std::string_view, 21> indexNames = {"bufferView",
                                                         "buffer",
                                                         "mesh",
                                                         "skin",
                                                         "camera",
                                                         "light",
                                                         "node",
                                                         "source",
                                                         "sampler",
                                                         "index",
                                                         "texCoord",
                                                         "material",
                                                         "indices",
                                                         "input",
                                                         "output",
                                                         "skeleton",
                                                         "inverseBindMatrices",
                                                         "scene",
                                                         "children",
                                                         "joints",
                                                         "nodes"};

constexpr std::array<std::string_view, 5> understoodExtensions = {
    "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_texture_transform",
    "KHR_mesh_quantization", "KHR_node_visibility"};

// What the file shows at rest does not depend on these.
constexpr std::array<std::string_view, 7> extensionsWithoutEffect = {
    "KHR_materials_variants", "KHR_animation_pointer", "KHR_node_hoverability",
    "KHR_node_selectability", "KHR_interactivity",     "KHR_xmp",
    "KHR_xmp_json_ld"};

// Other encodings of what the file holds once more in plain form, unless it requires them.
constexpr std::array<std::string_view, 7> encodings = {
    "KHR_draco_mesh_compression", "KHR_meshopt_compression", "EXT_meshopt_compression", "KHR_texture_basisu",
    "EXT_texture_webp",           "EXT_texture_avif",        "MSFT_texture_dds"};

bool contains(const auto& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool isIndex(const Json& value) {
    return value.is_number_integer() && value >= 0 && value <= std::numeric_limits<int32_t>::max();
}

void checkIndex(const std::string& key, const Json& value) {
    if (!isIndex(value))
        refuse("a key '" + key + "' is " + shown(value) + "; expected an index from 0 to 2147483647");
}

void checkIndices(const std::string& key, const Json& value) {
    // "nodes" and "indices" are also the names of lists of objects and of a sparse accessor's part.
    if (value.is_object()) return;
    if (!value.is_array()) return checkIndex(key, value);
    for (const Json& item : value)
        if (!item.is_object()) checkIndex(key, item);
}

// tinygltf narrows integers silently, so that 2^32 would be index 0. Nesting was bounded on parsing.
void checkAllIndices(const Json& value) {
    if (value.is_array())
        for (const Json& item : value) checkAllIndices(item);
    if (!value.is_object()) return;
    for (const auto& [key, item] : value.items()) {
        if (key == "extras" || key == "asset") continue;
        if (contains(indexNames, key)) checkIndices(key, item);
        if (key == "attributes" && item.is_object())
            for (const auto& [semantic, accessor] : item.items()) checkIndex(semantic, accessor);
        if (key != "extensions") checkAllIndices(item);
        else if (item.is_object())
            for (const auto& [name, extension] : item.items())
                if (contains(understoodExtensions, name)) checkAllIndices(extension);
    }
}

size_t byteCount(const Json& object, const char* key, const std::string& subject, bool required) {
    const auto found = object.find(key);
    if (found == object.end()) {
        if (required) refuse(subject + " lacks '" + key + "'");
        return 0;
    }
    if (!found->is_number_unsigned() || *found > largestGltfFile)
        refuse(subject + " has a '" + key + "' that is not an integer from 0 to " +
               std::to_string(largestGltfFile));
    return found->get<size_t>();
}

void checkVersion(const Json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object()) refuse("it is not glTF: the key 'asset' is missing");
    const auto version = asset->find("version");
    if (version == asset->end() || !version->is_string())
        refuse("it is not glTF: the key 'version' of 'asset' is missing");
    if (!version->get_ref<const std::string&>().starts_with("2."))
        refuse("it is glTF " + version->get<std::string>().substr(0, 20) + "; expected 2.0");
    // A version of which 2.0 is not enough.
    const auto least = asset->find("minVersion");
    if (least != asset->end() && (!least->is_string() || *least != "2.0"))
        refuse(std::string("it needs a reader of glTF ").append(shown(*least)) + "; 2.0 is what is read");
}

void checkExtensions(const Json& root) {
    const auto required = root.find("extensionsRequired");
    if (required == root.end()) return;
    if (!required->is_array()) refuse("the key 'extensionsRequired' is not a list");
    for (const Json& name : *required) {
        if (!name.is_string()) refuse("the key 'extensionsRequired' is not a list of strings");
        const std::string extension = name.get<std::string>();
        if (!contains(understoodExtensions, extension) && !contains(extensionsWithoutEffect, extension))
            refuse("it requires the extension '" + extension + "', which is not supported",
                   ErrorCode::unsupported);
    }
}

// The names of all extensions that occur. Nesting was bounded on parsing.
void collectExtensions(const Json& value, std::set<std::string>& names) {
    if (value.is_array())
        for (const Json& item : value) collectExtensions(item, names);
    if (!value.is_object()) return;
    for (const auto& [key, item] : value.items()) {
        if (key == "extras") continue;
        if (key == "extensions" && item.is_object())
            for (const auto& [name, extension] : item.items()) names.insert(name);
        collectExtensions(item, names);
    }
}

void noteExtensions(const Json& root, GltfNotes& notes) {
    std::set<std::string> names;
    collectExtensions(root, names);
    std::string ofSurfaces, others;
    for (const std::string& name : names) {
        if (contains(understoodExtensions, name) || contains(extensionsWithoutEffect, name) ||
            contains(encodings, name))
            continue;
        std::string& list = name.starts_with("KHR_materials_") ? ofSurfaces : others;
        list += (list.empty() ? "" : ", ") + shown(name);
    }
    if (!ofSurfaces.empty())
        notes.add("it uses " + ofSurfaces + ", which is left out: every surface is opaque and Lambertian");
    if (!others.empty()) notes.add("it uses " + others + ", which is not known and left out");
}

void checkLists(const Json& root) {
    for (const std::string_view name : listNames) {
        const auto list = root.find(name);
        if (list == root.end()) continue;
        if (!list->is_array() ||
            !std::all_of(list->begin(), list->end(), [](const Json& item) { return item.is_object(); }))
            refuse("the key '" + std::string(name) + "' is not a list of objects");
    }
}

std::vector<GltfBufferSource> listBuffers(const Json& root, size_t binarySize) {
    std::vector<GltfBufferSource> buffers;
    for (const Json& item : root.value("buffers", Json::array())) {
        const std::string subject = "buffer " + std::to_string(buffers.size());
        GltfBufferSource buffer;
        buffer.length = byteCount(item, "byteLength", subject, true);
        if (buffer.length == 0) refuse(subject + " has a 'byteLength' of 0");
        const auto uri = item.find("uri");
        if (uri != item.end() && !uri->is_string())
            refuse(subject + " has a 'uri' that is " + shown(*uri) + "; expected a string");
        if (uri != item.end()) buffer.uri = uri->get<std::string>();
        if (buffer.uri.empty() && buffers.empty() && buffer.length > binarySize)
            refuse(subject + " has a 'byteLength' of " + std::to_string(buffer.length) +
                   ", but no 'uri' and " + std::to_string(binarySize) + " bytes of binary data");
        if (buffer.uri.empty() && !buffers.empty()) refuse(subject + " lacks 'uri'");
        buffers.push_back(std::move(buffer));
    }
    return buffers;
}

void checkBufferViews(const Json& root, const std::vector<GltfBufferSource>& buffers) {
    size_t number = 0;
    for (const Json& view : root.value("bufferViews", Json::array())) {
        const std::string subject = "buffer view " + std::to_string(number++);
        const auto buffer = view.find("buffer");
        if (buffer == view.end() || !isIndex(*buffer) || *buffer >= buffers.size())
            refuse(subject + " does not name one of the " + std::to_string(buffers.size()) + " buffers");
        const size_t offset = byteCount(view, "byteOffset", subject, false);
        const size_t length = byteCount(view, "byteLength", subject, true);
        const size_t available = buffers[buffer->get<size_t>()].length;
        if (length == 0 || offset + length > available)
            refuse(subject + " takes " + std::to_string(length) + " bytes from byte " +
                   std::to_string(offset) + " of a buffer of " + std::to_string(available) + " bytes");
    }
}

} // namespace

std::vector<GltfBufferSource> checkGltfStructure(const nlohmann::json& root, size_t binarySize,
                                                 GltfNotes& notes) {
    checkVersion(root);
    checkExtensions(root);
    checkLists(root);
    checkAllIndices(root);
    checkGltfSchema(root);
    noteExtensions(root, notes);
    std::vector<GltfBufferSource> buffers = listBuffers(root, binarySize);
    checkBufferViews(root, buffers);
    return buffers;
}

} // namespace rebound::lab
