// SPDX-License-Identifier: MIT
// Files made after what users of other programs have reported; read where they are at hand.
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace rebound::lab {
namespace {

std::filesystem::path reports() {
    const char* shared = std::getenv("REBOUND_SHARED");
    const std::filesystem::path folder = std::filesystem::path(shared ? shared : "") / "reports";
    if (shared && std::filesystem::exists(folder)) return folder;
    MESSAGE("skipped: REBOUND_SHARED names no folder with reports/");
    return {};
}

Scene loaded(const std::filesystem::path& file) {
    Result<Scene> scene = loadScene(file.string());
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    return std::move(*scene);
}

} // namespace

TEST_CASE("reported files are read") {
    const std::filesystem::path folder = reports();
    if (folder.empty()) return;
    const Scene colored = loaded(folder / "vertex_colours/vcol.gltf");
    const auto square = std::find_if(colored.meshes.begin(), colored.meshes.end(),
                                     [](const Mesh& mesh) { return !mesh.colors.empty(); });
    REQUIRE(square != colored.meshes.end());
    for (const glm::vec4 corner : {glm::vec4(1, 0, 0, 1), {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 0, 1}})
        CHECK(std::find(square->colors.begin(), square->colors.end(), corner) != square->colors.end());

    loaded(folder / "skin_without_inverse_bind/skin_noibm.gltf");
    const Scene mapped = loaded(folder / "two_uv_sets/multiuv.gltf");
    CHECK(std::any_of(mapped.meshes.begin(), mapped.meshes.end(),
                      [](const Mesh& mesh) { return !mesh.emissionCoordinates.empty(); }));
    const Scene blended = loaded(folder / "alpha_blend/alpha.gltf");
    REQUIRE(blended.notes.size() == 1);
    CHECK(blended.notes[0].find("BLEND") != std::string::npos);
    for (const char* name : {"buf_nomime", "uri_charset", "uri_nomime", "uri_upper"})
        loaded(folder / "data_uri" / (std::string(name) + ".gltf"));
}

TEST_CASE("reported files that cannot be read are refused in sentences that help") {
    const std::filesystem::path folder = reports();
    if (folder.empty()) return;
    const Result<Scene> picture = loadScene((folder / "data_uri/webp_small.gltf").string());
    REQUIRE(!picture);
    CHECK(picture.error().message.find("image 0 is neither a PNG nor a JPEG file") != std::string::npos);
    CHECK(picture.error().message.size() < 300);
    const Result<Scene> dark = loadScene((folder / "no_light_message/nolight.gltf").string());
    REQUIRE(!dark);
    CHECK(dark.error().message.find(R"({"environment": {"type": "constant", "radiance": [1, 1, 1]}})") !=
          std::string::npos);
}

} // namespace rebound::lab
