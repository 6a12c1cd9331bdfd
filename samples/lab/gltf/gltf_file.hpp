// SPDX-License-Identifier: MIT
// A glTF file in memory, its buffers read and its structure checked as far as reading it safely needs.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace rebound::lab {

// Files and buffers are refused beyond these sizes.
inline constexpr size_t largestGltfFile = (size_t(1) << 31) - 1; // [bytes], of a file or a buffer
inline constexpr size_t largestGltfJson = size_t(1) << 27;       // [bytes]

// Buffers are complete and buffer views lie inside them. Images are not decoded: Image::image holds the
// encoded bytes of embedded ones, Image::uri names external ones. Throws InputError.
tinygltf::Model readGltfFile(const std::filesystem::path&);

// A URI relative to a glTF file, percent encoding undone.
std::filesystem::path resolveUri(const std::filesystem::path& gltfFile, const std::string& uri);

} // namespace rebound::lab
