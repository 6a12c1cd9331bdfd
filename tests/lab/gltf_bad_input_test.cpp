// SPDX-License-Identifier: MIT
// Every kind of damaged file is one clear error.
#include "gltf_errors.hpp"

#include <functional>

namespace rebound::lab::test {
namespace {

struct Damage {
    const char* name;
    std::function<void(GltfDraft&)> apply;
    const char* expected; // part of the message
};

void addNodes(GltfDraft& draft, const Json& nodes) { draft.root["nodes"] = nodes; }

const Damage damages[] = {
    {"no asset", [](GltfDraft& d) { d.root.erase("asset"); }, "'asset'"},
    {"version 1", [](GltfDraft& d) { d.root["asset"]["version"] = "1.0"; }, "1.0"},
    {"unknown required extension",
     [](GltfDraft& d) { d.root["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     "KHR_draco_mesh_compression"},
    {"required extensions of numbers", [](GltfDraft& d) { d.root["extensionsRequired"] = {1}; },
     "extensionsRequired"},
    {"nodes are no list", [](GltfDraft& d) { d.root["nodes"] = 3; }, "nodes"},
    {"meshes of numbers",
     [](GltfDraft& d) {
         d.root["meshes"] = {1, 2};
     },
     "'meshes'"},
    {"accessor index of 2^32",
     [](GltfDraft& d) { d.root["meshes"][0]["primitives"][0]["indices"] = 4294967297; }, "4294967297"},
    {"negative index", [](GltfDraft& d) { d.root["nodes"][0]["mesh"] = -5; }, "'mesh'"},
    {"index as text", [](GltfDraft& d) { d.root["nodes"][0]["mesh"] = "0"; }, "'mesh'"},
    {"fractional index", [](GltfDraft& d) { d.root["nodes"][0]["mesh"] = 0.5; }, "'mesh'"},
    {"missing mesh", [](GltfDraft& d) { d.root["nodes"][0]["mesh"] = 7; }, "mesh 7"},
    {"missing accessor",
     [](GltfDraft& d) { d.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }, "accessor 9"},
    {"attribute as text",
     [](GltfDraft& d) { d.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = "a"; }, "POSITION"},
    {"missing material", [](GltfDraft& d) { d.root["meshes"][0]["primitives"][0]["material"] = 2; },
     "material 2"},
    {"missing scene", [](GltfDraft& d) { d.root["scene"] = 4; }, "scene 4"},
    {"scene of a missing node", [](GltfDraft& d) { d.root["scenes"][0]["nodes"] = {3}; }, "node 3"},
    {"scene lists a node twice",
     [](GltfDraft& d) {
         d.root["scenes"][0]["nodes"] = {0, 0};
     },
     "twice"},
    {"missing child", [](GltfDraft& d) { d.root["nodes"][0]["children"] = {8}; }, "node 8"},
    {"child of two nodes",
     [](GltfDraft& d) {
         addNodes(d, {{{"mesh", 0}, {"children", {1}}}, Json::object(), {{"children", {1}}}});
     },
     "child twice"},
    {"child listed twice",
     [](GltfDraft& d) {
         addNodes(d, {{{"mesh", 0}, {"children", {1, 1}}}, Json::object()});
     },
     "child twice"},
    {"node as its own child", [](GltfDraft& d) { d.root["nodes"][0]["children"] = {0}; }, "cycle"},
    {"cycle of two",
     [](GltfDraft& d) {
         addNodes(d, {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}});
     },
     "cycle"},
    {"scene lists a child",
     [](GltfDraft& d) {
         addNodes(d, {{{"mesh", 0}}, {{"children", {0}}}});
     },
     "another node's child"},
    {"short matrix",
     [](GltfDraft& d) {
         d.root["nodes"][0]["matrix"] = {1, 0, 0};
     },
     "nodes[0].matrix"},
    {"short translation",
     [](GltfDraft& d) {
         d.root["nodes"][0]["translation"] = {1, 0};
     },
     "nodes[0].translation"},
    {"zero rotation",
     [](GltfDraft& d) {
         d.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "'rotation'"},
    {"overflowing transform",
     [](GltfDraft& d) {
         addNodes(d,
                  {{{"mesh", 0}, {"scale", {1e300, 1, 1}}, {"children", {1}}}, {{"scale", {1e300, 1, 1}}}});
     },
     "not finite"},
    {"transform out of a float's range",
     [](GltfDraft& d) {
         d.root["nodes"][0]["scale"] = {1e60, 1, 1};
     },
     "position"},
    {"huge count", [](GltfDraft& d) { d.root["accessors"][0]["count"] = 1099511627776; }, "1099511627776"},
    {"count whose size overflows",
     [](GltfDraft& d) { d.root["accessors"][0]["count"] = 1537228672809129302; }, "accessor 0"},
    {"count of zero", [](GltfDraft& d) { d.root["accessors"][0]["count"] = 0; }, "no elements"},
    {"negative count", [](GltfDraft& d) { d.root["accessors"][0]["count"] = -3; }, "count"},
    {"one element too many", [](GltfDraft& d) { d.root["accessors"][0]["count"] = 4; },
     "buffer view of 36 bytes"},
    {"offset beyond the view", [](GltfDraft& d) { d.root["accessors"][0]["byteOffset"] = 4; }, "from byte 4"},
    {"huge offset", [](GltfDraft& d) { d.root["accessors"][0]["byteOffset"] = 18446744073709551600u; },
     "accessor 0"},
    {"huge count without a buffer view",
     [](GltfDraft& d) {
         d.root["accessors"][0].erase("bufferView");
         d.root["accessors"][0]["count"] = 1099511627776;
     },
     "without a buffer view"},
    {"unknown component type", [](GltfDraft& d) { d.root["accessors"][0]["componentType"] = 5124; }, "5124"},
    {"unknown type", [](GltfDraft& d) { d.root["accessors"][0]["type"] = "VEC9"; }, "VEC9"},
    {"positions of two components", [](GltfDraft& d) { d.root["accessors"][0]["type"] = "VEC2"; },
     "2 components"},
    {"indices of floats",
     [](GltfDraft& d) {
         d.root["meshes"][0]["primitives"][0]["indices"] = 2;
         d.addAccessor<float>("SCALAR", 3, {0, 1, 2});
     },
     "unsigned integers"},
    {"index beyond the vertices",
     [](GltfDraft& d) {
         d.root["meshes"][0]["primitives"][0]["indices"] = 2;
         d.addAccessor<uint32_t>("SCALAR", 3, {0, 1, 3});
     },
     "index 3 for 3 vertices"},
    {"restart index",
     [](GltfDraft& d) {
         d.root["meshes"][0]["primitives"][0]["indices"] = 2;
         d.addAccessor<uint16_t>("SCALAR", 3, {0, 1, 65535});
     },
     "65535"},
    {"four indices",
     [](GltfDraft& d) {
         d.root["meshes"][0]["primitives"][0]["indices"] = 2;
         d.addAccessor<uint8_t>("SCALAR", 4, {0, 1, 2, 0});
     },
     "4 indices"},
    {"strip of two",
     [](GltfDraft& d) {
         d.root["meshes"][0]["primitives"][0]["mode"] = 5;
         d.root["accessors"][1]["count"] = 2;
     },
     "2 indices"},
    {"NaN position",
     [](GltfDraft& d) {
         const uint32_t nan = 0x7fc00000;
         std::memcpy(d.buffer.data() + 12, &nan, 4);
     },
     "not finite"},
    {"infinite position",
     [](GltfDraft& d) {
         const uint32_t inf = 0x7f800000;
         std::memcpy(d.buffer.data() + 12, &inf, 4);
     },
     "not finite"},
    {"too few normals",
     [](GltfDraft& d) {
         d.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
         d.addAccessor<float>("VEC3", 2, {0, 0, 1, 0, 0, 1});
     },
     "2 elements for 3 vertices"},
    {"view beyond the buffer", [](GltfDraft& d) { d.root["bufferViews"][0]["byteLength"] = 1000; },
     "1000 bytes"},
    {"view at a huge offset",
     [](GltfDraft& d) { d.root["bufferViews"][0]["byteOffset"] = 18446744073709551615u; }, "byteOffset"},
    {"view of a missing buffer", [](GltfDraft& d) { d.root["bufferViews"][0]["buffer"] = 1; },
     "buffer view 0"},
    {"view without a buffer", [](GltfDraft& d) { d.root["bufferViews"][0].erase("buffer"); },
     "buffer view 0"},
    {"stride below the element", [](GltfDraft& d) { d.root["bufferViews"][0]["byteStride"] = 8; },
     "stride of 8"},
    {"odd stride", [](GltfDraft& d) { d.root["bufferViews"][0]["byteStride"] = 13; }, "13"},
    {"buffer without a length",
     [](GltfDraft& d) {
         d.root["buffers"] = {{{"uri", "scene.bin"}}};
     },
     "byteLength"},
    {"buffer of length 0",
     [](GltfDraft& d) {
         d.root["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", 0}}};
     },
     "byteLength"},
    {"missing buffer file",
     [](GltfDraft& d) {
         d.root["buffers"] = {{{"uri", "none.bin"}, {"byteLength", 44}}};
     },
     "none.bin"},
    {"buffer file is a folder",
     [](GltfDraft& d) {
         d.root["buffers"] = {{{"uri", "."}, {"byteLength", 44}}};
     },
     "regular file"},
    {"buffer without a URI",
     [](GltfDraft& d) {
         d.root["buffers"] = {{{"byteLength", 44}}};
     },
     "no 'uri'"},
    {"data URI of a wrong length",
     [](GltfDraft& d) {
         d.root["buffers"] = {{{"byteLength", 44}, {"uri", "data:application/octet-stream;base64,AAAA"}}};
     },
     "buffer 0 has 3 bytes; expected 44"},
    {"primitive without attributes",
     [](GltfDraft& d) { d.root["meshes"][0]["primitives"][0].erase("attributes"); }, "attributes"},
    {"only points", [](GltfDraft& d) { d.root["meshes"][0]["primitives"][0]["mode"] = 0; }, "no triangles"},
    {"no nodes",
     [](GltfDraft& d) {
         d.root.erase("nodes");
         d.root["scenes"][0]["nodes"] = Json::array();
     },
     "no triangles"},
    {"sparse without values",
     [](GltfDraft& d) {
         d.root["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", 0}, {"componentType", 5121}}}};
     },
     "values"},
    {"sparse index out of range",
     [](GltfDraft& d) {
         const int places = d.addView<uint8_t>({3});
         const int values = d.addView<float>({1, 2, 3});
         d.root["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", values}}}};
     },
     "element 3 of 3"},
    {"sparse count beyond its views",
     [](GltfDraft& d) {
         const int places = d.addView<uint8_t>({1});
         const int values = d.addView<float>({1, 2, 3});
         d.root["accessors"][0]["sparse"] = {{"count", 2},
                                             {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", values}}}};
     },
     "list of places"},
    {"negative sparse count",
     [](GltfDraft& d) {
         d.root["accessors"][0]["sparse"] = {{"count", -1},
                                             {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", 0}}}};
     },
     "sparse part of -1"},
};

TEST_CASE("a damaged glTF file is refused with a message that names it and the damage") {
    TemporaryFolder folder;
    REQUIRE(loadGltf(triangleDraft().save(folder)));
    for (const Damage& damage : damages) {
        CAPTURE(std::string(damage.name));
        GltfDraft draft = triangleDraft();
        damage.apply(draft);
        checkError(errorOf(draft.save(folder)), "scene.gltf", damage.expected);
        checkOwnWords(errorOf(draft.save(folder)));
    }
}

TEST_CASE("a key that is missing or of another type is named by its path, with what was expected") {
    TemporaryFolder folder;
    struct Case {
        const char* patch; // RFC 7396
        const char* expected;
    };
    for (const Case& c : {
             Case{R"({"accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3"}]})",
                  "'accessors[0].count' is missing; expected a whole number"},
             Case{R"({"accessors": [{"bufferView": 0, "count": 3, "type": "VEC3"}]})",
                  "'accessors[0].componentType'"},
             Case{R"({"accessors": [{"componentType": 5126, "count": "3", "type": "VEC3"}]})",
                  "'accessors[0].count' is \"3\""},
             Case{R"({"accessors": [{"componentType": 5126, "count": 3, "type": 3}]})", "expected a string"},
             Case{R"({"meshes": [{}]})", "'meshes[0].primitives' is missing; expected a list of objects"},
             Case{R"({"meshes": [{"primitives": [3]}]})", "'meshes[0].primitives' is [3]"},
             Case{R"({"meshes": [{"primitives": [{"attributes": []}]}]})",
                  "'meshes[0].primitives[0].attributes'"},
             Case{R"({"skins": [{}]})", "'skins[0].joints' is missing"},
             Case{R"({"cameras": [{"type": "perspective"}]})", "lacks the key 'perspective'"},
             Case{R"({"cameras": [{"type": "orthographic", "orthographic": {"xmag": 1}}]})",
                  "'cameras[0].orthographic.ymag' is missing"},
             Case{R"({"cameras": [{"type": "fisheye"}]})", "expected perspective or orthographic"},
             Case{R"({"images": [{}]})", "image 0 has neither of the keys"},
             Case{R"({"images": [{"uri": "a", "bufferView": 0}]})", "image 0 has both of the keys"},
             Case{R"({"images": [{"uri": 3}]})", "'images[0].uri' is 3"},
             Case{R"({"materials": [{"pbrMetallicRoughness": {"metallicFactor": "high"}}]})",
                  "'materials[0].pbrMetallicRoughness.metallicFactor' is \"high\"; expected a finite number"},
             Case{R"({"materials": [{"normalTexture": {}}]})",
                  "'materials[0].normalTexture.index' is missing"},
             Case{R"({"nodes": [{"matrix": "unit"}]})", "'nodes[0].matrix'"},
             Case{R"({"animations": [{"channels": []}]})", "'animations[0].samplers' is missing"},
             Case{R"({"animations": [{"channels": [{"sampler": 0}], "samplers": []}]})",
                  "'animations[0].channels[0].target' is missing"},
             Case{R"({"extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot"}]}}})",
                  "lacks the key 'spot'"},
             Case{R"({"extensions": {"KHR_lights_punctual": {"lights": 3}}})", "expected a list of objects"},
             Case{R"({"extensions": 3})", "'extensions' is 3; expected an object"},
         }) {
        CAPTURE(c.patch);
        GltfDraft draft = triangleDraft();
        draft.root.merge_patch(Json::parse(c.patch));
        const std::string message = errorOf(draft.save(folder));
        checkError(message, "scene.gltf", c.expected);
        checkOwnWords(message);
    }
}

TEST_CASE("JSON that is damaged is refused with the place of the damage") {
    TemporaryFolder folder;
    writeText(folder / "a.gltf", "{\n  \"asset\": {\n    \"version\" \"2.0\"\n  }\n}");
    const std::string message = errorOf(folder / "a.gltf");
    checkError(message, "a.gltf", "near line 3, column 19");
    checkOwnWords(message);
    for (const char* text :
         {"", "{", "{\"a\": 1e999}", "{\"a\": \"\xff\"}", "{\"a\": tru}", "[1, 2", "{} {}"}) {
        CAPTURE(text);
        writeText(folder / "a.gltf", text);
        checkError(errorOf(folder / "a.gltf"), "a.gltf", "not glTF");
        checkOwnWords(errorOf(folder / "a.gltf"));
    }
}

TEST_CASE("what is not glTF is refused") {
    TemporaryFolder folder;
    checkError(errorOf(folder / "none.gltf"), "none.gltf", "does not exist");
    std::filesystem::create_directory(folder / "folder.gltf");
    checkError(errorOf(folder / "folder.gltf"), "folder.gltf", "regular file");
    for (const char* text :
         {"", "hello", "{", "[]", "3", "null", "{\"asset\": {\"version\": \"2.0\"}", "\xff\xfe"}) {
        CAPTURE(text);
        writeText(folder / "a.gltf", text);
        checkError(errorOf(folder / "a.gltf"), "a.gltf", "not glTF");
    }
    CHECK(loadGltf(folder / "none.gltf").error().code == ErrorCode::notFound);
}

TEST_CASE("nesting without end is refused") {
    TemporaryFolder folder;
    const std::string open(200000, '['), close(200000, ']');
    writeText(folder / "deep.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + open + close + "}");
    checkError(errorOf(folder / "deep.gltf"), "deep.gltf", "nested deeper than 64");
}

} // namespace
} // namespace rebound::lab::test
