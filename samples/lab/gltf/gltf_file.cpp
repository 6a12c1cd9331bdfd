// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_file.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/files/input_error.hpp"
#include "lab/files/json_text.hpp"
#include "lab/gltf/data_uri.hpp"
#include "lab/gltf/gltf_structure.hpp"
#include "lab/scenes/scene.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <span>
#include <string_view>
#include <vector>

namespace rebound::lab {
namespace {

struct Contents {
    std::string_view json;
    std::span<const uint8_t> binary; // of a .glb
};

uint32_t littleEndian(const uint8_t* bytes) {
    return uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16 | uint32_t(bytes[3]) << 24;
}

Contents splitBinary(const std::vector<uint8_t>& bytes) {
    constexpr size_t header = 12, chunkHeader = 8;
    constexpr uint32_t jsonChunk = 0x4E4F534A, binaryChunk = 0x004E4942;
    if (bytes.size() < header + chunkHeader) refuse("it ends within the header of a binary glTF file");
    if (littleEndian(&bytes[4]) != 2)
        refuse("it is binary glTF of version " + std::to_string(littleEndian(&bytes[4])) + "; expected 2");
    if (littleEndian(&bytes[8]) != bytes.size())
        refuse("its header says " + std::to_string(littleEndian(&bytes[8])) + " bytes, but the file has " +
               std::to_string(bytes.size()));
    const size_t jsonLength = littleEndian(&bytes[12]);
    const size_t jsonEnd = header + chunkHeader + jsonLength;
    if (littleEndian(&bytes[16]) != jsonChunk || jsonEnd > bytes.size() || jsonLength % 4 != 0)
        refuse("its JSON chunk is damaged or missing");
    Contents contents{{reinterpret_cast<const char*>(&bytes[header + chunkHeader]), jsonLength}, {}};
    if (jsonEnd == bytes.size()) return contents;
    if (jsonEnd + chunkHeader > bytes.size()) refuse("it ends within the header of its binary chunk");
    const size_t binarySize = littleEndian(&bytes[jsonEnd]);
    if (littleEndian(&bytes[jsonEnd + 4]) != binaryChunk || jsonEnd + chunkHeader + binarySize > bytes.size())
        refuse("its binary chunk is damaged or cut off");
    contents.binary = std::span(bytes).subspan(jsonEnd + chunkHeader, binarySize);
    return contents;
}

Contents split(const std::vector<uint8_t>& bytes) {
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) return splitBinary(bytes);
    return {{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}};
}

// Hands out the buffers in the order in which tinygltf asks for them, and nothing else: it knows fewer data URIs than
// there are, and images are read later, only where a material shows them.
struct BufferFiles {
    std::filesystem::path gltfFile;
    std::span<const uint8_t> binary; // of a .glb
    std::vector<GltfBufferSource> buffers;
    size_t next = 0;
};

bool bufferExists(const std::string&, void* files) {
    const auto* bufferFiles = static_cast<const BufferFiles*>(files);
    return bufferFiles->next < bufferFiles->buffers.size();
}

std::vector<uint8_t> bufferBytes(const BufferFiles& files, const GltfBufferSource& buffer,
                                 const std::string& subject) {
    if (buffer.uri.empty()) return {files.binary.begin(), files.binary.end()};
    if (isDataUri(buffer.uri)) return decodeDataUri(buffer.uri, subject);
    return readFileBytes(resolveUri(files.gltfFile, buffer.uri, subject), largestGltfFile, files.gltfFile);
}

bool readBuffer(std::vector<unsigned char>* bytes, std::string*, const std::string&, void* files) {
    auto* bufferFiles = static_cast<BufferFiles*>(files);
    const std::string subject = "buffer " + std::to_string(bufferFiles->next);
    const GltfBufferSource& buffer = bufferFiles->buffers[bufferFiles->next++];
    *bytes = bufferBytes(*bufferFiles, buffer, subject);
    const bool isFile = !buffer.uri.empty() && !isDataUri(buffer.uri);
    if (bytes->size() < buffer.length)
        refuse((isFile ? "its file '" + buffer.uri + "'" : subject) + " has " +
               std::to_string(bytes->size()) + " bytes; expected " + std::to_string(buffer.length));
    bytes->resize(buffer.length);
    return true;
}

bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    image->image.assign(bytes, bytes + size);
    return true;
}

// Images that are data URIs, by their index.
using EmbeddedImages = std::map<size_t, std::vector<uint8_t>>;

struct UnbackedIndices {
    size_t mesh = 0, primitive = 0;
    int accessor = 0;
};

// tinygltf 2.7 wants a buffer view for each accessor of indices. Without one they are zeros, but for a sparse part: such
// primitives are handed over without, and get their accessor back.
std::vector<UnbackedIndices> setAsideUnbackedIndices(nlohmann::json& root) {
    std::vector<UnbackedIndices> aside;
    if (!root.contains("meshes")) return aside;
    for (size_t mesh = 0; mesh < root["meshes"].size(); ++mesh) {
        nlohmann::json& primitives = root["meshes"][mesh]["primitives"];
        for (size_t i = 0; i < primitives.size(); ++i) {
            const auto indices = primitives[i].find("indices");
            if (indices == primitives[i].end()) continue;
            const int accessor = indices->get<int>();
            if (root["accessors"][size_t(accessor)].contains("bufferView")) continue;
            aside.push_back({mesh, i, accessor});
            primitives[i].erase(indices);
        }
    }
    return aside;
}

// Puts into the JSON what tinygltf 2.7 expects of it and glTF 2.0 does not: a file for every buffer, which readBuffer()
// then gives; data URIs of no other kind than it knows; and -1, its value for none, for optional indices that it takes
// for required.
EmbeddedImages adaptToTinygltf(nlohmann::json& root) {
    const auto each = [](nlohmann::json& object, const char* list, const auto& change) {
        if (const auto items = object.find(list); items != object.end())
            for (nlohmann::json& item : *items) change(item);
    };
    each(root, "buffers", [](nlohmann::json& buffer) { buffer["uri"] = "buffer"; });
    each(root, "skins", [](nlohmann::json& skin) { skin.emplace("inverseBindMatrices", none); });
    each(root, "animations", [&](nlohmann::json& animation) {
        each(animation, "channels", [](nlohmann::json& channel) { channel["target"].emplace("node", none); });
    });
    EmbeddedImages images;
    size_t number = 0;
    each(root, "images", [&](nlohmann::json& image) {
        const size_t index = number++;
        const std::string uri = image.value("uri", "");
        if (!isDataUri(uri)) return;
        images[index] = decodeDataUri(uri, "image " + std::to_string(index));
        image["uri"] = "embedded";
    });
    return images;
}

tinygltf::Model parseModel(const nlohmann::json& root, BufferFiles& files) {
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keepEncoded, nullptr);
    reader.SetFsCallbacks(
        {bufferExists, tinygltf::ExpandFilePath, readBuffer, tinygltf::WriteWholeFile, &files});
    tinygltf::Model model;
    std::string errors, warnings;
    const std::string text = root.dump();
    // No folder is given, as the callbacks know where buffers are.
    const bool success = reader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                                    static_cast<unsigned>(text.size()), {});
    // tinygltf drops what it cannot read, and goes on. checkGltfStructure() has named all that is known to make it fail.
    if (!success || !errors.empty())
        refuse("it is not glTF 2.0: a key is missing, out of its range or of another type than the "
               "specification says");
    return model;
}

} // namespace

std::filesystem::path resolveUri(const std::filesystem::path& gltfFile, const std::string& uri,
                                 const std::string& subject) {
    const size_t colon = uri.find(':');
    const bool hasScheme =
        colon != std::string::npos && colon > 1 &&
        std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.';
        });
    if (hasScheme)
        refuse(subject + " has the URI '" + uri.substr(0, 200) +
               "'; expected a file relative to this one, or data:");
    const std::string decoded = decodePercent(uri);
    if (decoded.find('\0') != std::string::npos) refuse(subject + " has a URI that holds a zero character");
    return gltfFile.parent_path() / decoded;
}

tinygltf::Model readGltfFile(const std::filesystem::path& file, GltfNotes& notes) {
    const std::vector<uint8_t> bytes = readFileBytes(file, largestGltfFile, file);
    const Contents contents = split(bytes);
    if (contents.json.size() > largestGltfJson)
        refuse("it has " + std::to_string(contents.json.size()) + " bytes of JSON; at most " +
               std::to_string(largestGltfJson) + " are read");
    nlohmann::json root = parseJsonObject(contents.json, "glTF");
    BufferFiles files{file, contents.binary, checkGltfStructure(root, contents.binary.size(), notes), 0};
    EmbeddedImages images = adaptToTinygltf(root);
    const std::vector<UnbackedIndices> aside = setAsideUnbackedIndices(root);
    tinygltf::Model model = parseModel(root, files);
    for (auto& [index, image] : images) {
        model.images.at(index).image = std::move(image);
        model.images.at(index).uri.clear();
    }
    for (const UnbackedIndices& indices : aside)
        model.meshes.at(indices.mesh).primitives.at(indices.primitive).indices = indices.accessor;
    return model;
}

} // namespace rebound::lab
