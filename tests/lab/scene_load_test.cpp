// SPDX-License-Identifier: MIT
// loadScene, and every shared scene where these are at hand.
#include "gltf_draft.hpp"

#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <limits>
#include <numeric>

namespace rebound::lab::test {
namespace {

const char* const minimalView =
    R"({"cameras": [], "lights": [], "environment": {"type": "constant", "radiance": [1, 1, 1]},
                                    "emissive_materials": true})";

struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};
};

Bounds boundsOf(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.low = glm::min(bounds.low, position);
        bounds.high = glm::max(bounds.high, position);
    }
    return bounds;
}

TEST_CASE("the view file beside a scene is used, unless another is named") {
    TemporaryFolder folder;
    const std::string file = triangleDraft().save(folder).string();
    const Result<Scene> dark = loadScene(file);
    REQUIRE(!dark);
    CHECK(dark.error().message.find("no light") != std::string::npos);
    writeText(folder / "view.json", minimalView);
    REQUIRE(loadScene(file));
    CHECK(loadScene(file)->environment == glm::vec3(1.0f));
    writeText(folder / "other.json", "{}");
    CHECK(!loadScene(file, folder / "other.json"));
    CHECK(!loadScene(file, folder / "none.json"));
    CHECK(loadScene((folder / "none.gltf").string()).error().code == ErrorCode::notFound);
    CHECK(!loadScene(""));
}

TEST_CASE("a scene without cameras gets one from which all of it is in view") {
    TemporaryFolder folder;
    writeText(folder / "view.json", minimalView);
    const Result<Scene> scene = loadScene(triangleDraft().save(folder).string());
    REQUIRE(scene);
    REQUIRE(scene->cameras.size() == 1);
    const CameraView& camera = scene->cameras[0];
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    for (const glm::vec3& corner : scene->meshes.at(0).positions) {
        const glm::vec3 away = corner - camera.position;
        CHECK(std::acos(glm::dot(glm::normalize(away), forward)) < camera.verticalFieldOfView / 2);
        CHECK(glm::dot(away, forward) > camera.nearPlane);
        CHECK(glm::dot(away, forward) < camera.farPlane);
    }
}

TEST_CASE("emissive surfaces light a scene, directly or by what is gathered") {
    TemporaryFolder folder;
    GltfDraft draft = triangleDraft();
    draft.add("materials", {{"emissiveFactor", {1, 1, 1}}});
    draft.root["meshes"][0]["primitives"][0]["material"] = 0;
    const std::string file = draft.save(folder).string();
    CHECK(loadScene(file));
    Json view = Json::parse(minimalView);
    view["environment"]["radiance"] = {0, 0, 0};
    writeText(folder / "view.json", view.dump());
    CHECK(loadScene(file));
    // What is no direct light may still be gathered.
    view["emissive_materials"] = false;
    writeText(folder / "view.json", view.dump());
    CHECK(loadScene(file));
    draft.root["materials"][0]["emissiveFactor"] = {0, 0, 0};
    draft.save(folder);
    CHECK(!loadScene(file));
}

TEST_CASE("the error of a scene without light holds the view file that lights it") {
    TemporaryFolder folder;
    const std::string file = triangleDraft().save(folder).string();
    const Result<Scene> dark = loadScene(file);
    REQUIRE(!dark);
    const std::string& message = dark.error().message;
    const size_t begin = message.find('{', message.find("no light"));
    REQUIRE(begin != std::string::npos);
    writeText(folder / "view.json", message.substr(begin, message.rfind('}') + 1 - begin));
    const Result<Scene> lit = loadScene(file);
    REQUIRE_MESSAGE(lit, (lit ? "" : lit.error().message));
    CHECK(lit->environment == glm::vec3(1.0f));
}

TEST_CASE("an unknown built-in scene's error lists those that exist") {
    const Result<Scene> scene = loadScene("builtin:castle");
    REQUIRE(!scene);
    CHECK(scene.error().code == ErrorCode::notFound);
    for (const char* part : {"castle", "builtin:atrium", "builtin:cornell"})
        CHECK(scene.error().message.find(part) != std::string::npos);
}

struct SharedScene {
    const char* name;
    size_t triangles;
    size_t materials;
    size_t cameras;
};

// From the table that comes with the scenes.
constexpr SharedScene sharedScenes[] = {
    {"sponza", 262267, 25, 3},    {"cornell_box", 34, 4, 2},       {"living_room", 5088, 7, 3},
    {"arena", 58772, 3, 3},       {"bridge_garden", 21883, 13, 3}, {"grate_hall", 360, 1, 2},
    {"jungle_hut", 18347, 15, 3}, {"fox_room", 586, 4, 2},         {"lava_room", 10620, 8, 2},
};

TEST_CASE("every shared scene has the triangles, materials and cameras of its description") {
    const char* shared = std::getenv("REBOUND_SHARED");
    if (!shared) {
        MESSAGE("skipped: REBOUND_SHARED does not name the folder of shared scenes");
        return;
    }
    for (const SharedScene& expected : sharedScenes) {
        CAPTURE(expected.name);
        const Result<Scene> scene =
            loadScene((std::filesystem::path(shared) / "scenes" / expected.name / "scene.gltf").string());
        REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
        CHECK(scene->triangleCount() == expected.triangles);
        CHECK(scene->materials.size() == expected.materials);
        CHECK(scene->cameras.size() == expected.cameras);
    }
}

TEST_CASE("the shared fox stands on the floor of its room in the middle of a step") {
    const char* shared = std::getenv("REBOUND_SHARED");
    if (!shared) {
        MESSAGE("skipped: REBOUND_SHARED does not name the folder of shared scenes");
        return;
    }
    const std::filesystem::path folder = std::filesystem::path(shared) / "scenes" / "fox_room";
    const Result<Scene> walking = loadScene((folder / "scene.gltf").string());
    const Result<Scene> resting = loadGltf(folder / "scene.gltf");
    REQUIRE(walking);
    REQUIRE(resting);
    const auto isFox = [](const Mesh& mesh) { return mesh.indices.size() == 576 * 3; };
    const auto fox = std::find_if(walking->meshes.begin(), walking->meshes.end(), isFox);
    const auto foxAtRest = std::find_if(resting->meshes.begin(), resting->meshes.end(), isFox);
    REQUIRE(fox != walking->meshes.end());
    REQUIRE(foxAtRest != resting->meshes.end());
    const Bounds bounds = boundsOf(*fox);
    // Its feet touch the floor to some centimetres; a fox this size is 0.5 m to 2.5 m long and high, and in
    // the room.
    CHECK(std::abs(bounds.low.y) < 0.1f);
    CHECK(bounds.high.y > 0.5f);
    CHECK(bounds.high.y < 2.5f);
    CHECK(glm::length(bounds.high - bounds.low) < 4.0f);
    CHECK(std::max(std::abs(bounds.low.x), std::abs(bounds.high.x)) < 2.8f);
    float moved = 0.0f;
    for (size_t i = 0; i < fox->positions.size(); ++i)
        moved = std::max(moved, glm::distance(fox->positions[i], foxAtRest->positions[i]));
    CHECK(moved > 0.02f);
    CHECK(moved < 1.5f);
}

} // namespace
} // namespace rebound::lab::test
