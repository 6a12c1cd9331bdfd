// SPDX-License-Identifier: MIT
// What changes the picture and is left out is named once; what an extension says is honoured, named or refused.
#include "gltf_draft.hpp"

#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace rebound::lab::test {
namespace {

Result<Scene> load(const GltfDraft& draft, const GltfOptions& options = {}) {
    TemporaryFolder folder;
    return loadGltf(draft.save(folder), options);
}

std::vector<std::string> notesOf(const GltfDraft& draft, const GltfOptions& options = {}) {
    const Result<Scene> scene = load(draft, options);
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    for (const std::string& note : scene->notes) CHECK(note.find("scene.gltf': ") != std::string::npos);
    return scene->notes;
}

// Exactly one note, which holds the text.
void checkNote(const GltfDraft& draft, const std::string& text, const GltfOptions& options = {}) {
    const std::vector<std::string> notes = notesOf(draft, options);
    REQUIRE(notes.size() == 1);
    INFO(notes[0]);
    CHECK(notes[0].find(text) != std::string::npos);
}

GltfDraft withMaterial(Json material) {
    GltfDraft draft = triangleDraft();
    draft.add("materials", std::move(material));
    draft.root["meshes"][0]["primitives"][0]["material"] = 0;
    return draft;
}

GltfDraft withTexture() {
    GltfDraft draft = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    draft.add("images",
              {{"bufferView", draft.addView(makePng(1, 1, 8, {1, 2, 3, 4}))}, {"mimeType", "image/png"}});
    draft.add("textures", {{"source", 0}});
    return draft;
}

} // namespace

TEST_CASE("a plain file has no notes") {
    CHECK(notesOf(triangleDraft()).empty());
    CHECK(notesOf(withTexture()).empty());
}

TEST_CASE("blending is taken for a mask at half opacity, and said") {
    GltfDraft draft = withMaterial({{"name", "glass"}, {"alphaMode", "BLEND"}, {"alphaCutoff", 0.1}});
    checkNote(draft, "material 0 ('glass') blends");
    const Material material = load(draft)->materials.at(0);
    CHECK(material.alphaMasked);
    CHECK(material.alphaCutoff == 0.5f);
    // Once, however many there are.
    draft.add("materials", {{"name", "haze"}, {"alphaMode", "BLEND"}});
    Json second = draft.root["meshes"][0]["primitives"][0];
    second["material"] = 1;
    draft.root["meshes"][0]["primitives"].push_back(second);
    checkNote(draft, "and so it is with 1 more");
}

TEST_CASE("textures that are left out are named") {
    for (const auto& [place, text] :
         {std::pair{"/normalTexture", "normal texture"}, std::pair{"/occlusionTexture", "occlusion texture"},
          std::pair{"/pbrMetallicRoughness/metallicRoughnessTexture", "metallic-roughness texture"}}) {
        GltfDraft draft = withTexture();
        draft.root["materials"][0][Json::json_pointer(place)] = {{"index", 0}};
        checkNote(draft, text);
    }
    GltfDraft filtered = withTexture();
    filtered.root["textures"][0]["sampler"] = 0;
    filtered.add("samplers", {{"magFilter", 9728}});
    checkNote(filtered, "texture 0 asks for its nearest texel");
}

TEST_CASE("lights' ranges and primitives that are no triangles are named") {
    GltfDraft lit = triangleDraft();
    lit.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"range", 3}}};
    lit.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    checkNote(lit, "light 0 has a range");
    lit.root["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "directional"; // which has none
    CHECK(notesOf(lit).empty());
    GltfDraft points = triangleDraft();
    points.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    checkNote(points, "primitive 1 of mesh 0");
}

TEST_CASE("extensions are honoured, named once, or refused where they are required") {
    for (const char* name : {"KHR_materials_clearcoat", "KHR_materials_transmission", "KHR_materials_unlit",
                             "KHR_materials_sheen", "KHR_materials_pbrSpecularGlossiness",
                             "KHR_materials_diffuse_transmission"}) {
        CAPTURE(name);
        GltfDraft draft = withMaterial({{"extensions", {{name, Json::object()}}}});
        checkNote(draft, std::string("it uses \"") + name + "\", which is left out");
        draft.root["extensionsRequired"] = {name};
        CHECK(!load(draft));
    }
    GltfDraft two = withMaterial(
        {{"extensions", {{"KHR_materials_ior", Json::object()}, {"KHR_materials_volume", Json::object()}}}});
    checkNote(two, "\"KHR_materials_ior\", \"KHR_materials_volume\"");
    for (const char* name : {"EXT_mesh_gpu_instancing", "EXT_lights_image_based", "ACME_fog"}) {
        CAPTURE(name);
        GltfDraft draft = triangleDraft();
        draft.root["nodes"][0]["extensions"][name] = Json::object();
        checkNote(draft, std::string("it uses \"") + name + "\", which is not known");
        draft.root["extensionsRequired"] = {name};
        const Result<Scene> scene = load(draft);
        REQUIRE(!scene);
        CHECK(scene.error().message.find(std::string("requires the extension '") + name) !=
              std::string::npos);
    }
    // These do not change what is shown, or are encodings of what is there in plain form too.
    for (const char* name : {"KHR_materials_variants", "KHR_xmp_json_ld", "KHR_node_selectability"}) {
        GltfDraft draft = triangleDraft();
        draft.root["meshes"][0]["extensions"][name] = Json::object();
        CHECK(notesOf(draft).empty());
        draft.root["extensionsRequired"] = {name};
        CHECK(load(draft));
    }
    for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu"}) {
        GltfDraft draft = triangleDraft();
        draft.root["meshes"][0]["extensions"][name] = Json::object();
        CHECK(notesOf(draft).empty());
        draft.root["extensionsRequired"] = {name};
        CHECK(!load(draft));
    }
    // What stands in "extras" is no extension.
    GltfDraft extra = triangleDraft();
    extra.root["extras"]["extensions"]["ACME_fog"] = Json::object();
    CHECK(notesOf(extra).empty());
}

TEST_CASE("hidden nodes hide their meshes and lights and those below them, not cameras") {
    GltfDraft draft = triangleDraft();
    draft.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    draft.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
    const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
    const Json light = {{"KHR_lights_punctual", {{"light", 0}}}};
    draft.root["nodes"] = {
        {{"mesh", 0}},
        {{"children", {2}}, {"extensions", hidden}},
        {{"mesh", 0}, {"children", {3}}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}},
        {{"camera", 0}, {"extensions", light}},
        {{"extensions", light}}};
    draft.root["scenes"][0]["nodes"] = {0, 1, 4};
    draft.root["extensionsRequired"] = {"KHR_node_visibility"};
    const Result<Scene> scene = load(draft);
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    CHECK(scene->meshes.size() == 1);
    CHECK(scene->lights.size() == 1);
    CHECK(scene->cameras.size() == 1);
    CHECK(scene->notes.empty());
    draft.root["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = 1;
    CHECK(!load(draft));
}

TEST_CASE("an animation of something else than nodes is named where it plays") {
    GltfDraft draft = triangleDraft();
    const int times = draft.addAccessor<float>("SCALAR", 1, {0});
    draft.add(
        "animations",
        {{"name", "fade"},
         {"samplers", {{{"input", times}, {"output", times}}}},
         {"channels",
          {{{"sampler", 0},
            {"target",
             {{"path", "pointer"},
              {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/alphaCutoff"}}}}}}}}}}});
    CHECK(notesOf(draft).empty());
    GltfOptions playing;
    playing.animate = true;
    checkNote(draft, "animation 'fade' animates something else than nodes", playing);
}

TEST_CASE("a version of glTF that 2.0 is not enough for is refused") {
    GltfDraft draft = triangleDraft();
    draft.root["asset"]["minVersion"] = "2.0";
    CHECK(load(draft));
    draft.root["asset"]["minVersion"] = "2.1";
    const Result<Scene> scene = load(draft);
    REQUIRE(!scene);
    CHECK(scene.error().message.find("\"2.1\"; 2.0 is what is read") != std::string::npos);
}

} // namespace rebound::lab::test
