// SPDX-License-Identifier: MIT
// Small glTF files, made and unmade on the spot.
#pragma once

#include "temporary_folder.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace rebound::lab::test {

using Json = nlohmann::json;
using Bytes = std::vector<uint8_t>;

inline void writeBytes(const std::filesystem::path& file, const void* data, size_t size) {
    std::ofstream(file, std::ios::binary)
        .write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

template <class T>
constexpr int componentTypeOf() {
    if constexpr (std::is_same_v<T, int8_t>) return 5120;
    else if constexpr (std::is_same_v<T, uint8_t>) return 5121;
    else if constexpr (std::is_same_v<T, int16_t>) return 5122;
    else if constexpr (std::is_same_v<T, uint16_t>) return 5123;
    else if constexpr (std::is_same_v<T, uint32_t>) return 5125;
    else return 5126;
}

// A glTF file under construction: its JSON, to be changed at will, and one buffer.
struct GltfDraft {
    Json root = {{"asset", {{"version", "2.0"}}}};
    Bytes buffer;

    int add(const char* list, Json item) {
        root[list].push_back(std::move(item));
        return static_cast<int>(root[list].size()) - 1;
    }

    template <class T>
    int addView(const std::vector<T>& values) {
        while (buffer.size() % 4 != 0) buffer.push_back(0);
        const size_t offset = buffer.size(), size = values.size() * sizeof(T);
        buffer.resize(offset + size);
        std::memcpy(buffer.data() + offset, values.data(), size);
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    }

    template <class T>
    int addAccessor(const char* type, size_t count, const std::vector<T>& values) {
        const int view = addView(values);
        return add("accessors", {{"bufferView", view},
                                 {"componentType", componentTypeOf<T>()},
                                 {"count", count},
                                 {"type", type}});
    }

    std::filesystem::path save(const TemporaryFolder& folder, const std::string& name = "scene.gltf") const {
        Json complete = root;
        if (!buffer.empty() && !complete.contains("buffers")) {
            complete["buffers"] = {{{"byteLength", buffer.size()}, {"uri", "scene.bin"}}};
            writeBytes(folder / "scene.bin", buffer.data(), buffer.size());
        }
        writeText(folder / name, complete.dump());
        return folder / name;
    }

    Bytes binary() const {
        Json complete = root;
        complete["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string text = complete.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        Bytes padded = buffer;
        padded.resize((padded.size() + 3) / 4 * 4, 0);
        Bytes file = {'g', 'l', 'T', 'F'};
        const auto append = [&](size_t value) {
            for (int i = 0; i < 4; ++i) file.push_back(static_cast<uint8_t>(value >> (8 * i)));
        };
        append(2);
        append(12 + 8 + text.size() + 8 + padded.size());
        append(text.size());
        append(0x4E4F534A);
        file.insert(file.end(), text.begin(), text.end());
        append(padded.size());
        append(0x004E4942);
        file.insert(file.end(), padded.begin(), padded.end());
        return file;
    }
};

// The triangle (0 0 0), (1 0 0), (0 1 0), facing +z, as mesh 0 of node 0 of scene 0; accessors: 0 positions,
// 1 indices.
inline GltfDraft triangleDraft() {
    GltfDraft draft;
    draft.addAccessor<float>("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    draft.addAccessor<uint16_t>("SCALAR", 3, {0, 1, 2});
    draft.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}});
    draft.add("nodes", {{"mesh", 0}});
    draft.add("scenes", {{"nodes", {0}}});
    draft.root["scene"] = 0;
    return draft;
}

// A PNG file of uncompressed rows. `samples`: rows of red, green, blue, alpha at 8 or 16 bits, most
// significant byte first.
inline Bytes makePng(uint32_t width, uint32_t height, int bits, const Bytes& samples) {
    const auto bigEndian = [](Bytes& to, uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<uint8_t>(value >> shift));
    };
    const auto chunk = [&](Bytes& to, const char* type, const Bytes& content) {
        bigEndian(to, static_cast<uint32_t>(content.size()));
        Bytes checked(type, type + 4);
        checked.insert(checked.end(), content.begin(), content.end());
        uint32_t crc = 0xffffffffu;
        for (const uint8_t byte : checked) {
            crc ^= byte;
            for (int i = 0; i < 8; ++i) crc = (crc >> 1) ^ ((crc & 1u) ? 0xedb88320u : 0u);
        }
        to.insert(to.end(), checked.begin(), checked.end());
        bigEndian(to, ~crc);
    };
    Bytes header;
    bigEndian(header, width);
    bigEndian(header, height);
    header.insert(header.end(), {static_cast<uint8_t>(bits), 6, 0, 0, 0});
    Bytes rows;
    const size_t pitch = samples.size() / std::max(height, 1u);
    for (size_t y = 0; y < height; ++y) {
        rows.push_back(0);
        rows.insert(rows.end(), samples.begin() + static_cast<std::ptrdiff_t>(y * pitch),
                    samples.begin() + static_cast<std::ptrdiff_t>((y + 1) * pitch));
    }
    uint32_t a = 1, b = 0;
    for (const uint8_t byte : rows) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<uint16_t>(rows.size());
    Bytes packed = {0x78,
                    0x01,
                    1,
                    static_cast<uint8_t>(size),
                    static_cast<uint8_t>(size >> 8),
                    static_cast<uint8_t>(~size),
                    static_cast<uint8_t>(~size >> 8)};
    packed.insert(packed.end(), rows.begin(), rows.end());
    bigEndian(packed, b << 16 | a);
    Bytes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    chunk(file, "IHDR", header);
    chunk(file, "IDAT", packed);
    chunk(file, "IEND", {});
    return file;
}

} // namespace rebound::lab::test
