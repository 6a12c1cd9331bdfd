// SPDX-License-Identifier: MIT
#include "lab/scenes/scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>

namespace rebound::lab {
namespace {

Scene goodScene() {
    Scene scene;
    scene.name = std::string("one");
    scene.materials.resize(1);
    Texture texture;
    texture.width = texture.height = 1;
    texture.rgba = {1, 2, 3, 4};
    scene.textures = {texture};
    scene.materials[0].baseColorTexture = 0;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.textureCoordinates.assign(3, glm::vec2(0.0f));
    mesh.indices = {0, 1, 2};
    scene.meshes = {mesh};
    scene.lights.resize(4);
    scene.lights[1].type = LightType::point;
    scene.lights[2].type = LightType::spot;
    scene.lights[3].type = LightType::area;
    for (const char* name : {"a", "b"}) {
        scene.cameras.emplace_back();
        scene.cameras.back().name = std::string(name);
    }
    return scene;
}

struct Damage {
    const char* name;
    std::function<void(Scene&)> apply;
};

const Damage damages[] = {
    {"no triangles", [](Scene& s) { s.meshes[0].indices.clear(); }},
    {"no meshes", [](Scene& s) { s.meshes.clear(); }},
    {"index out of range", [](Scene& s) { s.meshes[0].indices[1] = 3; }},
    {"indices not a multiple of 3", [](Scene& s) { s.meshes[0].indices.push_back(0); }},
    {"material out of range", [](Scene& s) { s.meshes[0].material = 1; }},
    {"no material", [](Scene& s) { s.meshes[0].material = none; }},
    {"texture out of range", [](Scene& s) { s.materials[0].baseColorTexture = 1; }},
    {"negative texture", [](Scene& s) { s.materials[0].emissionTexture = -2; }},
    {"texture of a wrong size", [](Scene& s) { s.textures[0].rgba.pop_back(); }},
    {"empty texture", [](Scene& s) { s.textures[0] = {}; }},
    {"NaN position", [](Scene& s) { s.meshes[0].positions[0].x = NAN; }},
    {"infinite position", [](Scene& s) { s.meshes[0].positions[0].x = INFINITY; }},
    {"position too far out", [](Scene& s) { s.meshes[0].positions[0].x = 1e16f; }},
    {"long normal",
     [](Scene& s) {
         s.meshes[0].normals[0] = {0, 0, 2};
     }},
    {"NaN normal",
     [](Scene& s) {
         s.meshes[0].normals[0] = {0, 0, NAN};
     }},
    {"too few normals", [](Scene& s) { s.meshes[0].normals.pop_back(); }},
    {"too few texture coordinates", [](Scene& s) { s.meshes[0].textureCoordinates.pop_back(); }},
    {"texture without coordinates", [](Scene& s) { s.meshes[0].textureCoordinates.clear(); }},
    {"NaN texture coordinate", [](Scene& s) { s.meshes[0].textureCoordinates[0].x = NAN; }},
    {"base colour above 1", [](Scene& s) { s.materials[0].baseColor.y = 1.5f; }},
    {"NaN base colour", [](Scene& s) { s.materials[0].baseColor.y = NAN; }},
    {"negative emission", [](Scene& s) { s.materials[0].emission.y = -1; }},
    {"NaN cutoff", [](Scene& s) { s.materials[0].alphaCutoff = NAN; }},
    {"negative light", [](Scene& s) { s.lights[0].intensity.x = -1; }},
    {"infinite light", [](Scene& s) { s.lights[0].intensity.x = INFINITY; }},
    {"long direction",
     [](Scene& s) {
         s.lights[0].direction = {0, -2, 0};
     }},
    {"NaN light position", [](Scene& s) { s.lights[1].position.x = NAN; }},
    {"inner cone beyond the outer", [](Scene& s) { s.lights[2].innerCone = 1; }},
    {"right along the direction",
     [](Scene& s) {
         s.lights[3].right = {0, 1, 0};
     }},
    {"area light without area", [](Scene& s) { s.lights[3].size.y = 0; }},
    {"negative environment", [](Scene& s) { s.environment.z = -1; }},
    {"camera at its target", [](Scene& s) { s.cameras[1].target = s.cameras[1].position; }},
    {"field of view of 0", [](Scene& s) { s.cameras[1].verticalFieldOfView = 0; }},
};

TEST_CASE("validate finds each kind of damage, and names the scene") {
    REQUIRE(validate(goodScene()));
    for (const Damage& damage : damages) {
        CAPTURE(damage.name);
        Scene scene = goodScene();
        damage.apply(scene);
        const Result<> valid = validate(scene);
        REQUIRE(!valid);
        CHECK(valid.error().message.find("'one'") != std::string::npos);
    }
}

TEST_CASE("triangles are counted over all meshes") {
    Scene scene = goodScene();
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[1].indices = {0, 1, 2, 0, 2, 1};
    CHECK(scene.triangleCount() == 3);
    CHECK(Scene().triangleCount() == 0);
}

TEST_CASE("cameras are found by name, the first without one") {
    const Scene scene = goodScene();
    CHECK(findCamera(scene, "")->name == "a");
    CHECK(findCamera(scene, "b")->name == "b");
    const Result<CameraView> missing = findCamera(scene, "c");
    REQUIRE(!missing);
    CHECK(missing.error().code == ErrorCode::notFound);
    CHECK(missing.error().message.find("'a', 'b'") != std::string::npos);
    CHECK(!findCamera(Scene(), ""));
}

} // namespace
} // namespace rebound::lab
