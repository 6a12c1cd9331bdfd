// SPDX-License-Identifier: MIT
// Positions, normals and texture coordinates against closed forms.
#include "gltf_draft.hpp"

#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace rebound::lab::test {
namespace {

Scene load(const GltfDraft& draft) {
    TemporaryFolder folder;
    Result<Scene> scene = loadGltf(draft.save(folder));
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    return std::move(*scene);
}

Mesh loadMesh(const GltfDraft& draft) { return load(draft).meshes.at(0); }

// Single rounding errors of coordinates up to about 10.
constexpr float rounding = 2e-6f;

void checkNear(const glm::vec3& a, const glm::vec3& b) {
    CAPTURE(a.x);
    CAPTURE(a.y);
    CAPTURE(a.z);
    CHECK(glm::distance(a, b) <= rounding);
}

glm::vec3 windingNormal(const Mesh& mesh) {
    const auto corner = [&](size_t i) { return mesh.positions.at(mesh.indices.at(i)); };
    return glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

TEST_CASE("a binary file says what its text twin says") {
    TemporaryFolder folder;
    const GltfDraft draft = triangleDraft();
    const Bytes binary = draft.binary();
    writeBytes(folder / "a.glb", binary.data(), binary.size());
    const Result<Scene> scene = loadGltf(folder / "a.glb");
    REQUIRE(scene);
    CHECK(scene->meshes.at(0).positions == loadMesh(draft).positions);
    CHECK(scene->meshes.at(0).positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("buffers come from data URIs and from percent-encoded names, longer than need be") {
    TemporaryFolder folder;
    GltfDraft draft = triangleDraft();
    draft.root["buffers"] = {{{"uri", "a%20b.bin"}, {"byteLength", draft.buffer.size()}}};
    Bytes longer = draft.buffer;
    longer.push_back(7);
    writeBytes(folder / "a b.bin", longer.data(), longer.size());
    CHECK(loadGltf(draft.save(folder)));
    // One vertex at the origin, thrice: 36 zero bytes.
    GltfDraft embedded;
    embedded.root["buffers"] = {
        {{"byteLength", 36}, {"uri", "data:application/octet-stream;base64," + std::string(48, 'A')}}};
    embedded.add("bufferViews", {{"buffer", 0}, {"byteLength", 36}});
    embedded.add("accessors", {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    embedded.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}});
    embedded.add("nodes", {{"mesh", 0}});
    CHECK(loadMesh(embedded).positions == std::vector<glm::vec3>(3, glm::vec3(0.0f)));
}

TEST_CASE("translation, rotation and scale apply from right to left, down the hierarchy") {
    GltfDraft draft = triangleDraft();
    const double half = std::numbers::sqrt2 / 2; // a quarter turn about z takes x to y and y to -x
    draft.root["nodes"] = {
        {{"children", {1}}, {"translation", {10, 0, 0}}},
        {{"mesh", 0}, {"translation", {0, 2, 0}}, {"rotation", {0, 0, half, half}}, {"scale", {3, 4, 5}}}};
    const Mesh mesh = loadMesh(draft);
    checkNear(mesh.positions.at(0), {10, 2, 0});
    checkNear(mesh.positions.at(1), {10, 5, 0});
    checkNear(mesh.positions.at(2), {6, 2, 0});
}

TEST_CASE("a matrix is stored column by column") {
    GltfDraft draft = triangleDraft();
    draft.root["nodes"][0]["matrix"] = {0, 0, 2, 0, 3, 0, 0, 0, 0, 1, 0, 0, 7, 8, 9, 1};
    const Mesh mesh = loadMesh(draft);
    checkNear(mesh.positions.at(0), {7, 8, 9});
    checkNear(mesh.positions.at(1), {7, 8, 11});
    checkNear(mesh.positions.at(2), {10, 8, 9});
}

TEST_CASE("normals stay at right angles to their surface under uneven scale and mirroring") {
    for (const double mirror : {1.0, -1.0}) {
        CAPTURE(mirror);
        GltfDraft draft;
        // In the plane x + z = 1.
        draft.addAccessor<float>("VEC3", 3, {1, 0, 0, 1, 1, 0, 0, 0, 1});
        const float half = std::numbers::sqrt2_v<float> / 2;
        draft.addAccessor<float>("VEC3", 3, {-half, 0, -half, -half, 0, -half, -half, 0, -half});
        draft.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}});
        draft.add("nodes", {{"mesh", 0}, {"scale", {4 * mirror, 1, 1}}});
        const Mesh mesh = loadMesh(draft);
        // The plane x / 4 + z = 1, mirrored in x, and the normal still on its old side.
        const glm::vec3 expected = -glm::normalize(glm::vec3(0.25 * mirror, 0, 1));
        checkNear(mesh.normals.at(0), expected);
        // The file's triangle faces +x +z and its normals say the opposite; both keep their sides.
        checkNear(windingNormal(mesh), -expected);
    }
}

TEST_CASE("a flattening transform still has normals") {
    GltfDraft draft = triangleDraft();
    draft.addAccessor<float>("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    draft.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
    draft.root["nodes"][0]["scale"] = {1, 1, 0};
    checkNear(loadMesh(draft).normals.at(0), {0, 0, 1});
}

TEST_CASE("triangles without normals are flat, mirrored ones too") {
    GltfDraft draft;
    // A roof: two triangles that share an edge.
    draft.addAccessor<float>("VEC3", 4, {0, 0, 0, 0, 0, -1, 1, 1, 0, -1, 1, 0});
    draft.addAccessor<uint8_t>("SCALAR", 6, {0, 2, 1, 0, 1, 3});
    draft.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}});
    draft.add("nodes", {{"mesh", 0}});
    const float half = std::numbers::sqrt2_v<float> / 2;
    const Mesh mesh = loadMesh(draft);
    REQUIRE(mesh.normals.size() == 6);
    for (size_t i = 0; i < 3; ++i) {
        checkNear(mesh.normals[i], {-half, half, 0});
        checkNear(mesh.normals[i + 3], {half, half, 0});
    }
    draft.root["nodes"][0]["scale"] = {1, -1, 1};
    const Mesh mirrored = loadMesh(draft);
    checkNear(mirrored.normals.at(0), {-half, -half, 0});
    checkNear(windingNormal(mirrored), mirrored.normals.at(0));
}

TEST_CASE("normals of no length become their triangle's") {
    GltfDraft draft = triangleDraft();
    draft.addAccessor<float>("VEC3", 3, {0, 0, 0, 0, 0, 0, 0, 0, 0});
    draft.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
    checkNear(loadMesh(draft).normals.at(2), {0, 0, 1});
}

TEST_CASE("strips and fans keep their winding, and points and lines are skipped") {
    for (const int mode : {5, 6}) {
        CAPTURE(mode);
        GltfDraft draft;
        // The corners of a square, in a strip's order or around it.
        draft.addAccessor<float>("VEC3", 4,
                                 mode == 5 ? std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}
                                           : std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        draft.add("meshes", {{"primitives",
                              {{{"attributes", {{"POSITION", 0}}}, {"mode", mode}},
                               {{"attributes", {{"POSITION", 0}}}, {"mode", 1}}}}});
        draft.add("nodes", {{"mesh", 0}});
        const Scene scene = load(draft);
        REQUIRE(scene.meshes.size() == 1);
        CHECK(scene.triangleCount() == 2);
        for (const glm::vec3& normal : scene.meshes[0].normals) checkNear(normal, {0, 0, 1});
    }
}

template <class T>
void checkPositions(const std::vector<T>& values, bool normalized, const std::vector<glm::vec3>& expected) {
    GltfDraft draft;
    draft.addAccessor<T>("VEC3", 3, values);
    draft.root["accessors"][0]["normalized"] = normalized;
    draft.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}});
    draft.add("nodes", {{"mesh", 0}});
    CAPTURE(componentTypeOf<T>());
    const Mesh mesh = loadMesh(draft);
    for (size_t i = 0; i < 3; ++i) checkNear(mesh.positions.at(i), expected[i]);
}

TEST_CASE("every component type, as it is and normalised") {
    const std::vector<glm::vec3> ends = {{0, 0, 0}, {1, 0, 0}, {0, 1, -1}};
    checkPositions<int8_t>({0, 0, 0, 127, 0, 0, 0, 127, -127}, true, ends);
    checkPositions<int8_t>({0, 0, 0, 127, 0, 0, 0, 127, -128}, true, ends);
    checkPositions<int16_t>({0, 0, 0, 32767, 0, 0, 0, 32767, -32768}, true, ends);
    checkPositions<uint8_t>({0, 0, 0, 255, 0, 0, 0, 51, 0}, true, {{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}});
    checkPositions<uint16_t>({0, 0, 0, 65535, 0, 0, 0, 13107, 0}, true, {{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}});
    checkPositions<uint32_t>({0, 0, 0, 4294967295u, 0, 0, 0, 858993459u, 0}, true,
                             {{0, 0, 0}, {1, 0, 0}, {0, 0.2f, 0}});
    checkPositions<int8_t>({0, 0, 0, 5, 0, 0, 0, -3, 0}, false, {{0, 0, 0}, {5, 0, 0}, {0, -3, 0}});
    checkPositions<uint16_t>({0, 0, 0, 500, 0, 0, 0, 3, 0}, false, {{0, 0, 0}, {500, 0, 0}, {0, 3, 0}});
}

TEST_CASE("interleaved attributes are read at their stride") {
    GltfDraft draft;
    // Position and texture coordinate, 20 bytes a vertex.
    draft.addView<float>({0, 0, 0, 0.1f, 0.2f, 1, 0, 0, 0.3f, 0.4f, 0, 1, 0, 0.5f, 0.6f});
    draft.root["bufferViews"][0]["byteStride"] = 20;
    draft.add("accessors", {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    draft.add(
        "accessors",
        {{"bufferView", 0}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
    draft.add("images",
              {{"bufferView", draft.addView(makePng(1, 1, 8, {1, 2, 3, 4}))}, {"mimeType", "image/png"}});
    draft.add("textures", {{"source", 0}});
    draft.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    draft.add("meshes",
              {{"primitives", {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"material", 0}}}}});
    draft.add("nodes", {{"mesh", 0}});
    const Mesh mesh = loadMesh(draft);
    CHECK(mesh.positions.at(2) == glm::vec3(0, 1, 0));
    CHECK(mesh.textureCoordinates == std::vector<glm::vec2>{{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}});
}

TEST_CASE("sparse accessors replace elements of a view, or of zeros") {
    for (const bool backed : {true, false}) {
        CAPTURE(backed);
        GltfDraft draft = triangleDraft();
        const int places = draft.addView<uint16_t>({1, 2});
        const int values = draft.addView<float>({5, 0, 0, 0, 6, 0});
        draft.root["accessors"][0]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", places}, {"componentType", 5123}}},
            {"values", {{"bufferView", values}}}};
        if (!backed) draft.root["accessors"][0].erase("bufferView");
        else draft.buffer[3] = 0x41; // the first x is 8
        const Mesh mesh = loadMesh(draft);
        CHECK(mesh.positions == std::vector<glm::vec3>{{backed ? 8 : 0, 0, 0}, {5, 0, 0}, {0, 6, 0}});
    }
}

TEST_CASE("indices without a buffer view are zeros, but for what a sparse part replaces") {
    GltfDraft draft = triangleDraft();
    const int places = draft.addView<uint8_t>({1, 2});
    const int values = draft.addView<uint16_t>({2, 1});
    Json& indices = draft.root["accessors"][1];
    indices.erase("bufferView");
    indices["sparse"] = {{"count", 2},
                         {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                         {"values", {{"bufferView", values}}}};
    const Mesh mesh = loadMesh(draft);
    // 0, 2, 1 of (0 0 0), (1 0 0), (0 1 0), which has no normals and so faces as it is wound.
    CHECK(mesh.positions == std::vector<glm::vec3>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
    CHECK(mesh.normals.at(0) == glm::vec3(0, 0, -1));
    indices.erase("sparse");
    CHECK(loadMesh(draft).positions == std::vector<glm::vec3>(3, glm::vec3(0.0f)));
}

TEST_CASE("morph targets are added by their weights") {
    GltfDraft draft = triangleDraft();
    const int target = draft.addAccessor<float>("VEC3", 3, {0, 0, 1, 0, 0, 2, 0, 0, 4});
    draft.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
    draft.root["meshes"][0]["weights"] = {0.5};
    CHECK(loadMesh(draft).positions == std::vector<glm::vec3>{{0, 0, 0.5f}, {1, 0, 1}, {0, 1, 2}});
    draft.root["nodes"][0]["weights"] = {0.25};
    CHECK(loadMesh(draft).positions == std::vector<glm::vec3>{{0, 0, 0.25f}, {1, 0, 0.5f}, {0, 1, 1}});
}

TEST_CASE("only the default scene's nodes are read, and a mesh in two places is there twice") {
    GltfDraft draft = triangleDraft();
    draft.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 3}}}, {{"mesh", 0}}};
    draft.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {0, 1}}}};
    draft.root["scene"] = 1;
    const Scene scene = load(draft);
    REQUIRE(scene.meshes.size() == 2);
    CHECK(scene.meshes[1].positions.at(0) == glm::vec3(0, 0, 3));
    draft.root.erase("scene");
    CHECK(load(draft).meshes.size() == 1);
    draft.root.erase("scenes");
    CHECK(load(draft).meshes.size() == 3);
}

} // namespace
} // namespace rebound::lab::test
