// SPDX-License-Identifier: MIT
// Materials, textures, lights and cameras of glTF files.
#include "gltf_draft.hpp"

#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace rebound::lab::test {
namespace {

// Rounding from double to single precision and of a few products.
constexpr float rounding = 2e-6f;

Result<Scene> load(const GltfDraft& draft) {
    TemporaryFolder folder;
    return loadGltf(draft.save(folder));
}

Scene loaded(const GltfDraft& draft) {
    Result<Scene> scene = load(draft);
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    return std::move(*scene);
}

std::string errorOf(const GltfDraft& draft) {
    const Result<Scene> scene = load(draft);
    return scene ? "no error" : scene.error().message;
}

bool mentions(const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos;
}

GltfDraft withMaterial(Json material) {
    GltfDraft draft = triangleDraft();
    draft.add("materials", std::move(material));
    draft.root["meshes"][0]["primitives"][0]["material"] = 0;
    return draft;
}

// A textured triangle whose image is the given file's bytes.
GltfDraft withImage(const Bytes& file) {
    GltfDraft draft = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    draft.add("images",
              {{"bufferView", draft.addView(file)}, {"mimeType", "image/png"}, {"name", "picture"}});
    draft.add("textures", {{"source", 0}});
    draft.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        draft.addAccessor<float>("VEC2", 3, {0, 0, 1, 0, 0, 1});
    return draft;
}

const Bytes twoTexels = {10, 20, 30, 40, 50, 60, 70, 80};

TEST_CASE("a material's factors, emission times strength, and mask") {
    const Scene scene = loaded(withMaterial(
        {{"name", "all"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 6}}}}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3}}));
    const Material& material = scene.materials.at(0);
    CHECK(material.name == "all");
    CHECK(material.baseColor == glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    CHECK(material.emission == glm::vec3(6, 3, 0));
    CHECK(material.metallic == 0.25f);
    CHECK(material.roughness == 0.75f);
    CHECK(material.alphaMasked);
    CHECK(material.alphaCutoff == 0.3f);
}

TEST_CASE("a primitive without a material gets glTF's default") {
    const Material material = loaded(triangleDraft()).materials.at(0);
    CHECK(material.baseColor == glm::vec4(1.0f));
    CHECK(material.emission == glm::vec3(0.0f));
    CHECK(!material.alphaMasked);
}

TEST_CASE("materials out of range are refused") {
    CHECK(mentions(errorOf(withMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", {2, 0, 0, 1}}}}})),
                   "base colour"));
    CHECK(mentions(errorOf(withMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", {-1, 0, 0, 1}}}}})),
                   "base colour"));
    CHECK(mentions(errorOf(withMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0}}}}})),
                   "baseColorFactor"));
    CHECK(mentions(errorOf(withMaterial({{"pbrMetallicRoughness", {{"metallicFactor", 7}}}})), "metallic"));
    CHECK(mentions(errorOf(withMaterial({{"emissiveFactor", {-1, 0, 0}}})), "emission"));
    CHECK(mentions(errorOf(withMaterial({{"emissiveFactor", {1e39, 0, 0}}})), "emission"));
    CHECK(mentions(errorOf(withMaterial({{"alphaMode", "GLASS"}})), "GLASS"));
    CHECK(mentions(errorOf(withMaterial({{"alphaCutoff", 1e39}})), "alpha cutoff"));
}

TEST_CASE("texels arrive as stored, row 0 on top, 16 bits cut to 8") {
    const Scene scene = loaded(withImage(makePng(1, 2, 8, twoTexels)));
    REQUIRE(scene.textures.size() == 1);
    const Texture& texture = scene.textures[0];
    CHECK(texture.name == "picture");
    CHECK(texture.width == 1);
    CHECK(texture.height == 2);
    CHECK(texture.rgba == twoTexels);
    CHECK(scene.materials.at(0).baseColorTexture == 0);

    // 0x8000 is 127.5019 of 255.
    const Bytes deep = {0, 0, 0xff, 0xff, 0x80, 0, 0x0a, 0x0a};
    CHECK(loaded(withImage(makePng(1, 1, 16, deep))).textures.at(0).rgba == Bytes{0, 255, 128, 10});
}

TEST_CASE("an image file beside the scene, with a space in its name") {
    TemporaryFolder folder;
    GltfDraft draft = withImage(makePng(1, 2, 8, twoTexels));
    const Bytes png = makePng(1, 2, 8, twoTexels);
    draft.root["images"][0] = {{"uri", "a%20picture.png"}};
    const std::filesystem::path file = draft.save(folder);
    const Result<Scene> missing = loadGltf(file);
    REQUIRE(!missing);
    CHECK(mentions(missing.error().message, "a picture.png' does not exist"));
    writeBytes(folder / "a picture.png", png.data(), png.size());
    const Result<Scene> scene = loadGltf(file);
    REQUIRE(scene);
    CHECK(scene->textures.at(0).rgba == twoTexels);
}

TEST_CASE("images that cannot be decoded are refused") {
    CHECK(mentions(errorOf(withImage({'G', 'I', 'F', '8', '9', 'a', 0, 0})), "neither a PNG nor a JPEG"));
    Bytes cut = makePng(1, 2, 8, twoTexels);
    cut.resize(cut.size() / 2);
    CHECK(mentions(errorOf(withImage(cut)), "cannot be decoded"));
    CHECK(mentions(errorOf(withImage(makePng(0, 0, 8, {}))), "0 x 0"));
    // Sizes that a header claims are refused before anything is decoded.
    CHECK(mentions(errorOf(withImage(makePng(20000, 1, 8, {}))), "20000 x 1"));
    CHECK(mentions(errorOf(withImage(makePng(16384, 16384, 8, {}))), "16384 x 16384"));
    CHECK(errorOf(withImage({0xff, 0xd8, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff})) != "no error");
    CHECK(errorOf(withImage({0xff, 0xd8, 0xff, 0xe0, 0, 0, 0xff, 0xe0, 0, 0, 0, 0})) != "no error");
}

TEST_CASE("references between materials, textures, images and samplers are checked") {
    const auto changed = [](const char* list, Json item) {
        GltfDraft draft = withImage(makePng(1, 2, 8, twoTexels));
        draft.root[list] = Json::array({std::move(item)});
        return errorOf(draft);
    };
    CHECK(mentions(changed("textures", {{"source", 4}}), "image 4"));
    CHECK(mentions(changed("textures", Json::object()), "names no PNG or JPEG"));
    CHECK(mentions(changed("textures", {{"source", 0}, {"sampler", 3}}), "sampler 3"));
    CHECK(mentions(changed("images", {{"bufferView", 99}, {"mimeType", "image/png"}}), "99"));
    CHECK(changed("images", Json::object()) != "no error");
    CHECK(mentions(changed("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 5}}}}}}),
                   "texture 5"));
    GltfDraft wrapped = withImage(makePng(1, 2, 8, twoTexels));
    wrapped.root["textures"][0]["sampler"] = 0;
    wrapped.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
    const Texture texture = loaded(wrapped).textures.at(0);
    CHECK(texture.wrapS == Wrap::clamp);
    CHECK(texture.wrapT == Wrap::mirror);
    wrapped.root["samplers"][0]["wrapS"] = 5;
    CHECK(mentions(errorOf(wrapped), "wrapping mode 5"));
}

TEST_CASE("texture coordinates of the set that a material names, transformed") {
    GltfDraft draft = withImage(makePng(1, 2, 8, twoTexels));
    draft.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        draft.addAccessor<float>("VEC2", 3, {0, 0, 1, 0, 0, 2});
    Json& info = draft.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["texCoord"] = 1;
    CHECK(loaded(draft).meshes.at(0).textureCoordinates.at(2) == glm::vec2(0, 2));
    // Scaled by (2 3), then a quarter turn that takes u to -v and v to u, then moved.
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {10, 20}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}};
    const std::vector<glm::vec2> moved = loaded(draft).meshes.at(0).textureCoordinates;
    // Rounding at coordinates of about 20.
    CHECK(glm::distance(moved.at(1), glm::vec2(10, 18)) <= 10 * rounding);
    CHECK(glm::distance(moved.at(2), glm::vec2(16, 20)) <= 10 * rounding);
    info["extensions"]["KHR_texture_transform"] = {{"offset", {1e300, 0}}};
    CHECK(errorOf(draft) != "no error");
    info["extensions"]["KHR_texture_transform"] = {{"offset", "left"}};
    CHECK(mentions(errorOf(draft), "offset"));
}

TEST_CASE("a textured primitive without texture coordinates gets zeros") {
    GltfDraft draft = withImage(makePng(1, 2, 8, twoTexels));
    draft.root["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    CHECK(loaded(draft).meshes.at(0).textureCoordinates == std::vector<glm::vec2>(3, glm::vec2(0.0f)));
}

GltfDraft withLight(Json light) {
    GltfDraft draft = triangleDraft();
    draft.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({std::move(light)});
    // A quarter turn about x takes -z, along which lights shine, to +y.
    const double half = std::numbers::sqrt2 / 2;
    draft.add("nodes", {{"translation", {1, 2, 3}},
                        {"rotation", {half, 0, 0, half}},
                        {"scale", {5, 5, 5}},
                        {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    draft.root["scenes"][0]["nodes"] = {0, 1};
    return draft;
}

TEST_CASE("punctual lights stand and shine where their nodes do") {
    const Light spot = loaded(withLight({{"type", "spot"},
                                         {"name", "lamp"},
                                         {"color", {1, 0.5, 0}},
                                         {"intensity", 4},
                                         {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}))
                           .lights.at(0);
    CHECK(spot.type == LightType::spot);
    CHECK(spot.name == "lamp");
    CHECK(spot.position == glm::vec3(1, 2, 3));
    CHECK(glm::distance(spot.direction, glm::vec3(0, 1, 0)) <= rounding);
    CHECK(spot.intensity == glm::vec3(4, 2, 0));
    CHECK(spot.innerCone == 0.1f);
    CHECK(spot.outerCone == 0.2f);
    CHECK(loaded(withLight({{"type", "point"}})).lights.at(0).intensity == glm::vec3(1.0f));
    const Light sun = loaded(withLight({{"type", "directional"}, {"range", 2}})).lights.at(0);
    CHECK(sun.type == LightType::directional);
    CHECK(glm::distance(sun.direction, glm::vec3(0, 1, 0)) <= rounding);
}

TEST_CASE("lights out of range are refused") {
    CHECK(mentions(errorOf(withLight({{"type", "neon"}})), "neon"));
    CHECK(mentions(errorOf(withLight({{"type", "point"}, {"intensity", -1}})), "intensity"));
    CHECK(mentions(errorOf(withLight({{"type", "point"}, {"color", {1, 1}}})), "color"));
    CHECK(mentions(
        errorOf(withLight({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.2}}}})),
        "cone"));
    CHECK(errorOf(withLight({{"type", "spot"}})) != "no error");
    GltfDraft missing = withLight({{"type", "point"}});
    missing.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 5;
    CHECK(mentions(errorOf(missing), "light 5"));
    missing.root["nodes"][1]["extensions"]["KHR_lights_punctual"] = Json::object();
    CHECK(mentions(errorOf(missing), "names no light"));
}

GltfDraft withCamera(Json camera) {
    GltfDraft draft = triangleDraft();
    draft.add("cameras", std::move(camera));
    const double half = std::numbers::sqrt2 / 2; // looks along +y, its up is +z
    draft.add("nodes",
              {{"camera", 0}, {"name", "eye"}, {"translation", {1, 2, 3}}, {"rotation", {half, 0, 0, half}}});
    draft.add("nodes", {{"camera", 0}, {"name", "eye"}});
    draft.root["scenes"][0]["nodes"] = {0, 1, 2};
    return draft;
}

TEST_CASE("cameras look along their nodes' -z") {
    const Scene scene = loaded(withCamera(
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.5}, {"zfar", 20}}}}));
    const CameraView& camera = scene.cameras.at(0);
    CHECK(camera.name == "eye");
    CHECK(scene.cameras.at(1).name == "eye 2");
    CHECK(camera.position == glm::vec3(1, 2, 3));
    CHECK(glm::distance(glm::normalize(camera.target - camera.position), glm::vec3(0, 1, 0)) <= rounding);
    CHECK(glm::distance(camera.up, glm::vec3(0, 0, 1)) <= rounding);
    CHECK(camera.verticalFieldOfView == 0.8f);
    CHECK(camera.nearPlane == 0.5f);
    CHECK(camera.farPlane == 20.0f);
    const Scene flat = loaded(withCamera(
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}));
    CHECK(flat.cameras.at(0).orthographic);
    CHECK(flat.cameras.at(0).orthographicHeight == 4.0f);
}

TEST_CASE("cameras out of range are refused") {
    const auto perspective = [](double yfov, double znear, double zfar) {
        return errorOf(withCamera(
            {{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", znear}, {"zfar", zfar}}}}));
    };
    CHECK(mentions(perspective(0, 1, 2), "field of view"));
    CHECK(mentions(perspective(3.2, 1, 2), "field of view"));
    CHECK(mentions(perspective(1, 0, 2), "near"));
    CHECK(mentions(perspective(1, 3, 2), "near, far"));
    CHECK(perspective(1, 1e-30, 1e39) != "no error");
    CHECK(errorOf(withCamera({{"type", "fisheye"}})) != "no error");
    CHECK(errorOf(withCamera({{"type", "perspective"}})) != "no error");
    GltfDraft missing = withCamera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
    missing.root["nodes"][1]["camera"] = 6;
    CHECK(mentions(errorOf(missing), "camera 6"));
}

} // namespace
} // namespace rebound::lab::test
