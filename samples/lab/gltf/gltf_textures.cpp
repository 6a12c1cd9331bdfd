// SPDX-License-Identifier: MIT
#include "lab/gltf/gltf_textures.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_accessors.hpp"
#include "lab/gltf/gltf_file.hpp"

#include <cstring>
#include <optional>

namespace rebound::lab {
namespace {

using Bytes = std::vector<unsigned char>;

uint32_t bigEndian(const Bytes& bytes, size_t at, size_t count) {
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
    return value;
}

struct PictureSize {
    uint32_t width = 0;
    uint32_t height = 0;
};

std::optional<PictureSize> sizeOfPng(const Bytes& bytes) {
    constexpr unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (bytes.size() < 24 || std::memcmp(bytes.data(), signature, sizeof signature) != 0) return std::nullopt;
    return PictureSize{bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
}

// Walks over the segments to the frame header, whose markers are C0 to CF but for C4, C8 and CC.
std::optional<PictureSize> sizeOfJpeg(const Bytes& bytes) {
    if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return std::nullopt;
    for (size_t at = 2; at + 9 <= bytes.size();) {
        const unsigned char marker = bytes[at + 1];
        if (bytes[at] != 0xff || marker == 0xff) {
            ++at;
            continue;
        }
        if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
            return PictureSize{bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2)};
        at += 2 + bigEndian(bytes, at + 2, 2);
    }
    return std::nullopt;
}

// The size is known before decoding, so that a small file cannot claim all memory.
PictureSize checkedSize(const Bytes& bytes, const std::string& subject) {
    std::optional<PictureSize> size = sizeOfPng(bytes);
    if (!size) size = sizeOfJpeg(bytes);
    if (!size) refuse(subject + " is neither a PNG nor a JPEG file");
    const size_t texels = size_t(size->width) * size->height;
    if (texels == 0 || size->width > largestTextureSide || size->height > largestTextureSide ||
        texels > largestTextureSize)
        refuse(subject + " has " + std::to_string(size->width) + " x " + std::to_string(size->height) +
               " texels; expected 1 to " + std::to_string(largestTextureSide) + " a side and at most " +
               std::to_string(largestTextureSize));
    return *size;
}

std::vector<uint8_t> toBytes(const tinygltf::Image& image) {
    if (image.bits == 8) return image.image;
    std::vector<uint8_t> bytes(image.image.size() / 2);
    for (size_t i = 0; i < bytes.size(); ++i) {
        uint16_t value = 0;
        std::memcpy(&value, &image.image[i * 2], sizeof value);
        bytes[i] = static_cast<uint8_t>((value + 128u) / 257u);
    }
    return bytes;
}

Wrap wrapOf(int mode, const std::string& subject) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirror;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp;
    default:
        refuse(subject + " has the wrapping mode " + std::to_string(mode) + ", which glTF does not know");
    }
}

Texture decode(const Bytes& bytes, const std::string& subject, size_t& total) {
    const PictureSize size = checkedSize(bytes, subject);
    total += size_t(size.width) * size.height;
    if (total > largestTextureTotal)
        refuse("its textures have more than " + std::to_string(largestTextureTotal) + " texels");
    tinygltf::Image image;
    std::string errors, warnings;
    // Four channels of whatever the file holds are this decoder's default.
    if (!tinygltf::LoadImageData(&image, 0, &errors, &warnings, 0, 0, bytes.data(),
                                 static_cast<int>(bytes.size()), nullptr))
        refuse(subject + " cannot be decoded");
    Texture texture;
    texture.width = image.width;
    texture.height = image.height;
    texture.rgba = toBytes(image);
    if (texture.rgba.size() != static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4)
        refuse(subject + " cannot be decoded to red, green, blue and alpha");
    return texture;
}

} // namespace

int GltfTextures::use(int gltfTexture) {
    const tinygltf::Texture& source = itemAt(model.textures, gltfTexture, "texture");
    const std::string subject = "texture " + std::to_string(gltfTexture);
    if (source.source < 0) refuse(subject + " names no PNG or JPEG image");
    const tinygltf::Image& image = itemAt(model.images, source.source, "image");
    Wrap wrapS = Wrap::repeat, wrapT = Wrap::repeat;
    if (source.sampler >= 0) {
        const tinygltf::Sampler& sampler = itemAt(model.samplers, source.sampler, "sampler");
        wrapS = wrapOf(sampler.wrapS, subject);
        wrapT = wrapOf(sampler.wrapT, subject);
        if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST)
            notes.add(GltfNotes::Kind::nearestFilter, subject);
    }
    const auto key = std::make_tuple(source.source, wrapS, wrapT);
    if (const auto known = indices.find(key); known != indices.end()) return known->second;
    const bool external = !image.uri.empty();
    const std::string shown = external ? image.uri : image.name;
    const std::string imageName =
        "image " + std::to_string(source.source) + (shown.empty() ? "" : " ('" + shown.substr(0, 200) + "')");
    Texture texture = decode(
        external ? readFileBytes(resolveUri(file, image.uri, imageName), largestGltfFile, file) : image.image,
        imageName, total);
    texture.name = image.name.empty() ? image.uri : image.name;
    texture.wrapS = wrapS;
    texture.wrapT = wrapT;
    textures.push_back(std::move(texture));
    const int index = static_cast<int>(textures.size()) - 1;
    indices.emplace(key, index);
    return index;
}

} // namespace rebound::lab
