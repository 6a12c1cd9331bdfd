// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_file.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/files/input_error.hpp"
#include "lab/files/json_text.hpp"
#include "lab/gltf/gltf_structure.hpp"

#include <nlohmann/json.hpp>

#include <cctype>
#include <cstring>
#include <vector>

namespace rebound::lab {
namespace {

struct Contents {
    const char* json = nullptr;
    size_t jsonLength = 0;
    size_t binarySize = 0;
    bool isBinary = false; // .glb
};

uint32_t littleEndian(const uint8_t* bytes) {
    return uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8 | uint32_t(bytes[2]) << 16 | uint32_t(bytes[3]) << 24;
}

// Checks the chunks itself: tinygltf 2.7 lets the binary chunk end eight bytes beyond the file.
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
    Contents contents{reinterpret_cast<const char*>(&bytes[header + chunkHeader]), jsonLength, 0, true};
    if (jsonEnd == bytes.size()) return contents;
    if (jsonEnd + chunkHeader > bytes.size()) refuse("it ends within the header of its binary chunk");
    contents.binarySize = littleEndian(&bytes[jsonEnd]);
    if (littleEndian(&bytes[jsonEnd + 4]) != binaryChunk ||
        jsonEnd + chunkHeader + contents.binarySize > bytes.size())
        refuse("its binary chunk is damaged or cut off");
    return contents;
}

Contents split(const std::vector<uint8_t>& bytes) {
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) return splitBinary(bytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size(), 0, false};
}

// Hands out the external buffers in the order in which tinygltf asks for them, and nothing else: images are
// read later, only where a material shows them.
struct BufferFiles {
    std::filesystem::path gltfFile;
    std::vector<GltfBufferSource> buffers; // external ones only
    size_t next = 0;
};

bool bufferExists(const std::string&, void* files) {
    const auto* bufferFiles = static_cast<const BufferFiles*>(files);
    return bufferFiles->next < bufferFiles->buffers.size();
}

bool readBuffer(std::vector<unsigned char>* bytes, std::string*, const std::string&, void* files) {
    auto* bufferFiles = static_cast<BufferFiles*>(files);
    const GltfBufferSource& buffer = bufferFiles->buffers[bufferFiles->next++];
    const std::filesystem::path file = resolveUri(bufferFiles->gltfFile, buffer.uri);
    *bytes = readFileBytes(file, largestGltfFile, bufferFiles->gltfFile);
    if (bytes->size() < buffer.length)
        refuse("its file '" + file.string() + "' has " + std::to_string(bytes->size()) + " bytes; expected " +
               std::to_string(buffer.length));
    bytes->resize(buffer.length);
    return true;
}

bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    image->image.assign(bytes, bytes + size);
    return true;
}

} // namespace

std::filesystem::path resolveUri(const std::filesystem::path& gltfFile, const std::string& uri) {
    std::string decoded;
    for (size_t i = 0; i < uri.size(); ++i) {
        const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
        decoded += escaped ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
        i += escaped ? 2 : 0;
    }
    if (decoded.find('\0') != std::string::npos) refuse("a URI holds a zero character");
    return gltfFile.parent_path() / decoded;
}

tinygltf::Model readGltfFile(const std::filesystem::path& file) {
    const std::vector<uint8_t> bytes = readFileBytes(file, largestGltfFile, file);
    const Contents contents = split(bytes);
    if (contents.jsonLength > largestGltfJson)
        refuse("it has " + std::to_string(contents.jsonLength) + " bytes of JSON; at most " +
               std::to_string(largestGltfJson) + " are read");

    BufferFiles files{file, {}, 0};
    for (GltfBufferSource& buffer : checkGltfStructure(
             parseJsonObject({contents.json, contents.jsonLength}, "glTF"), contents.binarySize))
        if (buffer.external) files.buffers.push_back(std::move(buffer));

    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keepEncoded, nullptr);
    reader.SetFsCallbacks(
        {bufferExists, tinygltf::ExpandFilePath, readBuffer, tinygltf::WriteWholeFile, &files});
    tinygltf::Model model;
    std::string errors, warnings;
    // No folder is given, as the callbacks know where buffers are.
    const bool success = contents.isBinary
                             ? reader.LoadBinaryFromMemory(&model, &errors, &warnings, bytes.data(),
                                                           static_cast<unsigned>(bytes.size()), {})
                             : reader.LoadASCIIFromString(&model, &errors, &warnings, contents.json,
                                                          static_cast<unsigned>(contents.jsonLength), {});
    // tinygltf drops what it cannot read, and goes on.
    if (!success || !errors.empty()) refuse("it is not valid glTF: " + errors);
    return model;
}

} // namespace rebound::lab
