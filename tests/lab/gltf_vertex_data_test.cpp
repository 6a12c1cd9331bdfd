// SPDX-License-Identifier: MIT
// Colours of vertices, and sets of texture coordinates, from the file to a surface.
#include "gltf_draft.hpp"

#include "lab/rays/embree_scene.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

namespace rebound::lab::test {
namespace {

Result<Scene> load(const GltfDraft& draft) {
    TemporaryFolder folder;
    return loadGltf(draft.save(folder));
}

Scene loaded(const GltfDraft& draft) {
    Result<Scene> scene = load(draft);
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    return std::move(*scene);
}

Json& attributes(GltfDraft& draft) { return draft.root["meshes"][0]["primitives"][0]["attributes"]; }

// The surface of the triangle at barycentric weights of its second and third corner.
SurfacePoint surface(const Scene& scene, float u, float v) {
    const auto embree = EmbreeScene::build(scene);
    REQUIRE(embree);
    return embree->surfaceAt({0, 0, u, v}, {0, 0, -1});
}

void checkNear(const glm::vec3& a, const glm::vec3& b) {
    CAPTURE(a.x);
    CAPTURE(a.y);
    CAPTURE(a.z);
    CHECK(glm::distance(a, b) <= 1e-6f); // rounding of a few products of numbers up to 1
}

const std::vector<glm::vec4> redGreenBlue = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};

} // namespace

TEST_CASE("COLOR_0 multiplies the base colour, whatever its type, components and stride") {
    const auto check = [](GltfDraft draft, int accessor) {
        attributes(draft)["COLOR_0"] = accessor;
        draft.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 0.25, 1}}}}});
        draft.root["meshes"][0]["primitives"][0]["material"] = 0;
        const Scene scene = loaded(draft);
        CHECK(scene.meshes.at(0).colors == redGreenBlue);
        checkNear(surface(scene, 0, 0).albedo, {0.5f, 0, 0});
        checkNear(surface(scene, 1, 0).albedo, {0, 1, 0});
        checkNear(surface(scene, 0, 1).albedo, {0, 0, 0.25f});
        checkNear(surface(scene, 0.25f, 0.5f).albedo, {0.125f, 0.25f, 0.125f});
    };
    GltfDraft draft = triangleDraft();
    check(draft, draft.addAccessor<float>("VEC3", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}));
    draft = triangleDraft(); // what is beyond 0 to 1 is clamped
    check(draft, draft.addAccessor<float>("VEC4", 3, {1, 0, -1, 1, 0, 1, 0, 1, 0, 0, 1, 3}));
    draft = triangleDraft();
    int accessor = draft.addAccessor<uint8_t>("VEC4", 3, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255});
    draft.root["accessors"][size_t(accessor)]["normalized"] = true;
    check(draft, accessor);
    draft = triangleDraft(); // three bytes of every four
    accessor = draft.addAccessor<uint8_t>("VEC3", 3, {255, 0, 0, 9, 0, 255, 0, 9, 0, 0, 255, 9});
    draft.root["accessors"][size_t(accessor)]["normalized"] = true;
    draft.root["bufferViews"].back()["byteStride"] = 4;
    check(draft, accessor);
    draft = triangleDraft();
    accessor = draft.addAccessor<uint16_t>("VEC3", 3, {65535, 0, 0, 0, 65535, 0, 0, 0, 65535});
    draft.root["accessors"][size_t(accessor)]["normalized"] = true;
    check(draft, accessor);
    draft = triangleDraft(); // shading that is flat shares no vertices, and keeps their colours
    draft.root["accessors"][1]["count"] = 3;
    check(draft, draft.addAccessor<float>("VEC3", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}));
}

TEST_CASE("a vertex's opacity cuts holes into a masked material") {
    GltfDraft draft = triangleDraft();
    attributes(draft)["COLOR_0"] = draft.addAccessor<float>("VEC4", 3, {1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1});
    draft.add("materials", {{"alphaMode", "MASK"}, {"alphaCutoff", 0.5}});
    draft.root["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = loaded(draft);
    const auto embree = EmbreeScene::build(scene);
    REQUIRE(embree);
    // Opacity is 1 - u, and u is the place's x.
    CHECK(embree->occluded({{0.45f, 0.1f, 1.0f}}));
    CHECK_FALSE(embree->occluded({{0.55f, 0.1f, 1.0f}}));
}

TEST_CASE("morph targets move colours and texture coordinates") {
    GltfDraft draft = triangleDraft();
    attributes(draft)["COLOR_0"] = draft.addAccessor<float>("VEC3", 3, {1, 0, 0, 0, 0, 0, 0, 0, 0});
    const int difference = draft.addAccessor<float>("VEC3", 3, {-0.5f, 0, 0, 0, 1, 0, 0, 0, 4});
    draft.root["meshes"][0]["primitives"][0]["targets"] = {{{"COLOR_0", difference}}};
    draft.root["meshes"][0]["weights"] = {0.5};
    const auto colors = loaded(draft).meshes.at(0).colors;
    CHECK(colors == std::vector<glm::vec4>{{0.75f, 0, 0, 1}, {0, 0.5f, 0, 1}, {0, 0, 1, 1}});
}

TEST_CASE("colours that glTF does not know are refused") {
    const auto refused = [](GltfDraft draft, int accessor, const char* part) {
        attributes(draft)["COLOR_0"] = accessor;
        const Result<Scene> scene = load(draft);
        REQUIRE(!scene);
        INFO(scene.error().message);
        CHECK(scene.error().message.find(part) != std::string::npos);
    };
    GltfDraft draft = triangleDraft();
    refused(draft, draft.addAccessor<uint8_t>("VEC4", 3, Bytes(12, 255)), "neither floats nor normalised");
    refused(draft, draft.addAccessor<float>("VEC2", 3, std::vector<float>(6, 1)), "2 components where 4");
    refused(draft, draft.addAccessor<float>("VEC3", 2, std::vector<float>(6, 1)),
            "2 elements for 3 vertices");
    refused(draft, 99, "accessor 99");
}

TEST_CASE("each texture finds its texels by its own set of coordinates and its own transform") {
    // Two texels side by side: red and green.
    const Bytes png = makePng(2, 1, 8, {255, 0, 0, 255, 0, 255, 0, 255});
    GltfDraft draft = triangleDraft();
    draft.add("images", {{"bufferView", draft.addView(png)}, {"mimeType", "image/png"}});
    draft.add("textures", {{"source", 0}});
    draft.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                            {"emissiveFactor", {1, 1, 1}},
                            {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}});
    draft.root["meshes"][0]["primitives"][0]["material"] = 0;
    attributes(draft)["TEXCOORD_0"] = draft.addAccessor<float>("VEC2", 3, {0.25f, 0, 0.25f, 0, 0.25f, 0});
    attributes(draft)["TEXCOORD_1"] = draft.addAccessor<float>("VEC2", 3, {0.75f, 0, 0.75f, 0, 0.75f, 0});
    const Scene bySet = loaded(draft);
    CHECK(bySet.meshes.at(0).textureCoordinates.at(0) == glm::vec2(0.25f, 0));
    CHECK(bySet.meshes.at(0).emissionCoordinates.at(0) == glm::vec2(0.75f, 0));
    checkNear(surface(bySet, 0.2f, 0.2f).albedo, {1, 0, 0});
    checkNear(surface(bySet, 0.2f, 0.2f).emission, {0, 1, 0});

    // The same set, moved by half a texture for the emission alone.
    draft.root["materials"][0]["emissiveTexture"] = {
        {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
    const Scene byTransform = loaded(draft);
    checkNear(surface(byTransform, 0.2f, 0.2f).albedo, {1, 0, 0});
    checkNear(surface(byTransform, 0.2f, 0.2f).emission, {0, 1, 0});

    // One mapping for both needs no second list.
    draft.root["materials"][0]["emissiveTexture"] = {{"index", 0}};
    const Scene shared = loaded(draft);
    CHECK(shared.meshes.at(0).emissionCoordinates.empty());
    checkNear(surface(shared, 0.2f, 0.2f).emission, {1, 0, 0});

    // An emission texture alone.
    draft.root["materials"][0].erase("pbrMetallicRoughness");
    draft.root["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    checkNear(surface(loaded(draft), 0.2f, 0.2f).emission, {0, 1, 0});
}

} // namespace rebound::lab::test
