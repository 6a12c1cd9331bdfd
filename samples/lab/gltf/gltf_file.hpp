// SPDX-License-Identifier: MIT
// A glTF file in memory, its buffers read and its structure checked as far as reading it safely needs.
#pragma once

#include "lab/gltf/gltf_notes.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace rebound::lab {

// Files and buffers are refused beyond these sizes.
inline constexpr size_t largestGltfFile = (size_t(1) << 31) - 1; // [bytes], of a file or a buffer
inline constexpr size_t largestGltfJson = size_t(1) << 27;       // [bytes]

// Buffers are complete and buffer views lie inside them. Images are not decoded: Image::image holds the
// encoded bytes of embedded ones, whose Image::uri is empty; Image::uri names external ones. Throws InputError.
tinygltf::Model readGltfFile(const std::filesystem::path&, GltfNotes&);

// A URI relative to a glTF file, percent encoding undone. Refuses URIs that are no files beside it. `subject` is what has
// the URI.
std::filesystem::path resolveUri(const std::filesystem::path& gltfFile, const std::string& uri,
                                 const std::string& subject);

} // namespace rebound::lab
