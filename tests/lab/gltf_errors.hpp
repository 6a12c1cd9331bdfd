// SPDX-License-Identifier: MIT
// What a damaged glTF file's error has to be like.
#pragma once

#include "gltf_draft.hpp"

#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

namespace rebound::lab::test {

inline std::string errorOf(const std::filesystem::path& file, const GltfOptions& options = {}) {
    const Result<Scene> scene = loadGltf(file, options);
    return scene ? "no error" : scene.error().message;
}

inline void checkError(const std::string& message, const std::string& file, const std::string& expected) {
    INFO(message);
    CHECK(message.find(file) != std::string::npos);
    CHECK(message.find(expected) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
}

// Words that only libraries use: of JSON, glTF, pictures.
inline void checkOwnWords(const std::string& message) {
    INFO(message);
    for (const char* word :
         {"json.exception", "parse error", "syntax error", "Parse", "Failed", "property", "`", "tinygltf"})
        CHECK(message.find(word) == std::string::npos);
}

} // namespace rebound::lab::test
