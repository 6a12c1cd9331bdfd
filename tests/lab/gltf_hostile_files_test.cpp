// SPDX-License-Identifier: MIT
// Files that are large, cut or damaged at random.
#include "gltf_errors.hpp"

#include <random>

namespace rebound::lab::test {
namespace {

TEST_CASE("a chain of a hundred thousand nodes is no recursion") {
    TemporaryFolder folder;
    GltfDraft draft = triangleDraft();
    constexpr int length = 100000;
    Json nodes = Json::array();
    for (int i = 0; i < length; ++i) nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}, {"translation", {1, 0, 0}}});
    draft.root["nodes"] = nodes;
    const Result<Scene> scene = loadGltf(draft.save(folder));
    REQUIRE(scene);
    CHECK(scene->meshes.at(0).positions.at(0) == glm::vec3(1, 0, 0));
}

TEST_CASE("a mesh copied without bounds is refused before memory runs out") {
    TemporaryFolder folder;
    GltfDraft draft = triangleDraft();
    draft.root["accessors"][0].erase("bufferView");
    draft.root["accessors"][0]["count"] = 1 << 20; // the most that one accessor may claim
    draft.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 0;
    const Json primitive = draft.root["meshes"][0]["primitives"][0];
    draft.root["meshes"][0]["primitives"] = Json(33, primitive);
    checkError(errorOf(draft.save(folder)), "scene.gltf", "more than 33554432 vertices");
}

TEST_CASE("a cut binary file is refused at every length") {
    TemporaryFolder folder;
    const Bytes whole = triangleDraft().binary();
    writeBytes(folder / "a.glb", whole.data(), whole.size());
    REQUIRE(loadGltf(folder / "a.glb"));
    for (size_t length = 0; length < whole.size(); ++length) {
        CAPTURE(length);
        writeBytes(folder / "a.glb", whole.data(), length);
        CHECK(errorOf(folder / "a.glb") != "no error");
    }
}

TEST_CASE("a binary file whose chunk lengths lie is refused") {
    TemporaryFolder folder;
    const Bytes whole = triangleDraft().binary();
    const size_t jsonLength = whole[12] | size_t(whole[13]) << 8;
    for (const size_t at : {size_t(8), size_t(12), 20 + jsonLength})
        for (const uint8_t difference : {uint8_t(4), uint8_t(8), uint8_t(0xff)}) {
            Bytes damaged = whole;
            damaged[at] = static_cast<uint8_t>(damaged[at] + difference);
            if (at == 20 + jsonLength && difference == 0xff) damaged[at + 3] = 0xff;
            CAPTURE(at);
            CAPTURE(int(difference));
            writeBytes(folder / "a.glb", damaged.data(), damaged.size());
            CHECK(errorOf(folder / "a.glb") != "no error");
        }
}

TEST_CASE("bytes changed at random never do worse than an error") {
    TemporaryFolder folder;
    const Bytes whole = triangleDraft().binary();
    std::mt19937 random(1);
    int refused = 0;
    for (int round = 0; round < 500; ++round) {
        Bytes damaged = whole;
        for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = static_cast<uint8_t>(random());
        writeBytes(folder / "a.glb", damaged.data(), damaged.size());
        const Result<Scene> scene = loadGltf(folder / "a.glb");
        if (scene) CHECK(validate(*scene));
        else checkOwnWords(scene.error().message);
        refused += scene ? 0 : 1;
    }
    // Nearly all of the file is JSON and indices, where few changes are harmless.
    CHECK(refused > 250);
}

} // namespace
} // namespace rebound::lab::test
