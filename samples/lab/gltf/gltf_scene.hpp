// SPDX-License-Identifier: MIT
// A glTF file that is read once and seen at many moments.
#pragma once

#include "lab/scenes/scene_files.hpp"

#include <memory>

namespace rebound::lab {

class GltfScene {
public:
    static Result<GltfScene> open(const std::filesystem::path&);
    GltfScene(GltfScene&&) noexcept;
    GltfScene& operator=(GltfScene&&) noexcept;
    ~GltfScene();

    // What loadGltf() gives for that moment. Pictures are decoded the first time.
    Result<Scene> at(const GltfOptions&) &;
    // The last one, which takes the textures along.
    Result<Scene> at(const GltfOptions&) &&;

private:
    struct File;
    explicit GltfScene(std::unique_ptr<File>);
    std::unique_ptr<File> file;
};

} // namespace rebound::lab
