// SPDX-License-Identifier: MIT
// What must hold in a glTF file's JSON before tinygltf may read it.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace rebound::lab {

struct GltfBufferSource {
    std::string uri;   // empty: the binary chunk of a .glb
    size_t length = 0; // [bytes]
    bool external = false;
};

// Checks version, required extensions, that lists are lists of objects, that every index is one, and that
// buffer views lie inside their buffers: tinygltf drops or follows such things unchecked. `binarySize` is the
// size of a .glb's binary chunk. Returns the buffers. Throws InputError.
std::vector<GltfBufferSource> checkGltfStructure(const nlohmann::json&, size_t binarySize);

} // namespace rebound::lab
