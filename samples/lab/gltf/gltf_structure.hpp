// SPDX-License-Identifier: MIT
// What must hold in a glTF file's JSON before tinygltf may read it.
#pragma once

#include "lab/gltf/gltf_notes.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace rebound::lab {

struct GltfBufferSource {
    std::string uri;   // a file's or a data URI; empty: the binary chunk of a .glb
    size_t length = 0; // [bytes]
};

// Checks version, required extensions, that lists are lists of objects, that every index is one, that keys are there and
// of their types, and that buffer views lie inside their buffers: tinygltf drops or follows such things unchecked, or
// complains in words of its own. `binarySize` is the size of a .glb's binary chunk. Notes extensions that change the
// picture and are left out. Returns the buffers. Throws InputError.
std::vector<GltfBufferSource> checkGltfStructure(const nlohmann::json&, size_t binarySize, GltfNotes&);

} // namespace rebound::lab
