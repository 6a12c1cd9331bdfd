// SPDX-License-Identifier: MIT
// Keyframes, skins and morph weights at a moment, against closed forms.
#include "gltf_draft.hpp"

#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace rebound::lab::test {
namespace {

// Single rounding errors of coordinates up to about 10.
constexpr float rounding = 4e-6f;

void checkNear(const glm::vec3& a, const glm::vec3& b) {
    CAPTURE(a.x);
    CAPTURE(a.y);
    CAPTURE(a.z);
    CHECK(glm::distance(a, b) <= rounding);
}

int addClip(GltfDraft& draft, const std::string& name, const char* path, const char* interpolation, int times,
            int values) {
    return draft.add(
        "animations",
        {{"name", name},
         {"samplers", {{{"input", times}, {"output", values}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
}

Result<Scene> loadAt(const GltfDraft& draft, float time, const std::string& clip = {}) {
    TemporaryFolder folder;
    return loadGltf(draft.save(folder), {clip, time, true});
}

std::vector<glm::vec3> positionsAt(const GltfDraft& draft, float time, const std::string& clip = {}) {
    const Result<Scene> scene = loadAt(draft, time, clip);
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    return scene->meshes.at(0).positions;
}

TEST_CASE("linear translation, held before the first key and after the last") {
    GltfDraft draft = triangleDraft();
    addClip(draft, "move", "translation", "LINEAR", draft.addAccessor<float>("SCALAR", 2, {1, 3}),
            draft.addAccessor<float>("VEC3", 2, {0, 0, 0, 4, 8, 0}));
    checkNear(positionsAt(draft, 0)[0], {0, 0, 0});
    checkNear(positionsAt(draft, 1)[0], {0, 0, 0});
    checkNear(positionsAt(draft, 1.5f)[0], {1, 2, 0});
    checkNear(positionsAt(draft, 3)[0], {4, 8, 0});
    checkNear(positionsAt(draft, 99)[0], {4, 8, 0});
    checkNear(positionsAt(draft, -5)[0], {0, 0, 0});
}

TEST_CASE("without animation a file is at rest") {
    GltfDraft draft = triangleDraft();
    addClip(draft, "move", "translation", "STEP", draft.addAccessor<float>("SCALAR", 1, {0}),
            draft.addAccessor<float>("VEC3", 1, {9, 9, 9}));
    TemporaryFolder folder;
    const Result<Scene> scene = loadGltf(draft.save(folder));
    REQUIRE(scene);
    CHECK(scene->meshes.at(0).positions.at(0) == glm::vec3(0.0f));
}

TEST_CASE("steps hold a key until the next") {
    GltfDraft draft = triangleDraft();
    addClip(draft, "grow", "scale", "STEP", draft.addAccessor<float>("SCALAR", 2, {0, 1}),
            draft.addAccessor<float>("VEC3", 2, {2, 2, 2, 5, 5, 5}));
    checkNear(positionsAt(draft, 0.99f)[1], {2, 0, 0});
    checkNear(positionsAt(draft, 1.0f)[1], {5, 0, 0});
}

TEST_CASE("rotations turn evenly along the shorter arc, also between negated quaternions") {
    const float half = std::numbers::sqrt2_v<float> / 2;
    for (const float sign : {1.0f, -1.0f}) {
        GltfDraft draft = triangleDraft();
        // From none to a quarter turn about z.
        addClip(draft, "turn", "rotation", "LINEAR", draft.addAccessor<float>("SCALAR", 2, {0, 1}),
                draft.addAccessor<float>("VEC4", 2, {0, 0, 0, 1, 0, 0, sign * half, sign * half}));
        const float angle = std::numbers::pi_v<float> / 6; // after a third of the time
        checkNear(positionsAt(draft, 1.0f / 3.0f)[1], {std::cos(angle), std::sin(angle), 0});
    }
}

TEST_CASE("rotations of normalised bytes") {
    GltfDraft draft = triangleDraft();
    // A half turn about z.
    const int values = draft.addAccessor<int8_t>("VEC4", 1, {0, 0, 127, 0});
    draft.root["accessors"][static_cast<size_t>(values)]["normalized"] = true;
    addClip(draft, "turn", "rotation", "LINEAR", draft.addAccessor<float>("SCALAR", 1, {0}), values);
    checkNear(positionsAt(draft, 0)[1], {-1, 0, 0});
}

TEST_CASE("cubic splines go through their keys with their tangents") {
    GltfDraft draft = triangleDraft();
    // x(t) = t^3 over 0 to 2: tangents 0 and 12; in-tangent, value, out-tangent a key.
    addClip(draft, "spline", "translation", "CUBICSPLINE", draft.addAccessor<float>("SCALAR", 2, {0, 2}),
            draft.addAccessor<float>("VEC3", 6, {0, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 0, 0, 0}));
    for (const float t : {0.0f, 0.5f, 1.0f, 1.7f, 2.0f})
        checkNear(positionsAt(draft, t)[0], {t * t * t, 0, 0});
}

TEST_CASE("clips are found by name, and an unknown name lists them") {
    GltfDraft draft = triangleDraft();
    const int times = draft.addAccessor<float>("SCALAR", 1, {0});
    addClip(draft, "one", "translation", "STEP", times, draft.addAccessor<float>("VEC3", 1, {1, 0, 0}));
    addClip(draft, "two", "translation", "STEP", times, draft.addAccessor<float>("VEC3", 1, {2, 0, 0}));
    checkNear(positionsAt(draft, 0)[0], {1, 0, 0});
    checkNear(positionsAt(draft, 0, "two")[0], {2, 0, 0});
    const Result<Scene> unknown = loadAt(draft, 0, "three");
    REQUIRE(!unknown);
    CHECK(unknown.error().code == ErrorCode::notFound);
    CHECK(unknown.error().message.find("'one', 'two'") != std::string::npos);
    CHECK(!loadAt(draft, NAN));
    CHECK(loadAt(triangleDraft(), 0));
    CHECK(!loadAt(triangleDraft(), 0, "one"));
}

TEST_CASE("animated morph weights") {
    GltfDraft draft = triangleDraft();
    const int target = draft.addAccessor<float>("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    draft.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}, {{"POSITION", target}}};
    addClip(draft, "morph", "weights", "LINEAR", draft.addAccessor<float>("SCALAR", 2, {0, 1}),
            draft.addAccessor<float>("SCALAR", 4, {0, 0, 1, 2}));
    checkNear(positionsAt(draft, 0.5f)[0], {0, 0, 1.5f});
}

// The triangle's corners hang on joints 1 and 2, which stand at (1 0 0) and (2 0 0).
GltfDraft skinnedDraft(const std::vector<float>& weights, const std::vector<uint8_t>& joints) {
    GltfDraft draft = triangleDraft();
    const int jointsAccessor = draft.addAccessor<uint8_t>("VEC4", 3, joints);
    const int weightsAccessor = draft.addAccessor<float>("VEC4", 3, weights);
    Json& attributes = draft.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = jointsAccessor;
    attributes["WEIGHTS_0"] = weightsAccessor;
    const int inverseBind =
        draft.addAccessor<float>("MAT4", 2, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1, //
                                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0, 0, 1});
    draft.root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}},
                           {{"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}},
                           {{"translation", {2, 0, 7}}}};
    draft.root["scenes"][0]["nodes"] = {0, 1, 2};
    draft.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", inverseBind}});
    return draft;
}

TEST_CASE("skinned vertices follow their joints, not their node") {
    // Wholly joint 1, wholly joint 2, and one part of each in weights that add up to 4.
    const GltfDraft draft =
        skinnedDraft({1, 0, 0, 0, 1, 0, 0, 0, 1, 3, 0, 0}, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
    const std::vector<glm::vec3> positions = positionsAt(draft, 0);
    // Joint 1 doubles distances from (1 0 0); joint 2 moves by 7 along z.
    checkNear(positions[0], {-1, 0, 0});
    checkNear(positions[1], {1, 0, 7});
    checkNear(positions[2], 0.25f * glm::vec3(-1, 2, 0) + 0.75f * glm::vec3(0, 1, 7));
}

TEST_CASE("a skin without inverse bind matrices has identities") {
    const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 3, 0, 0};
    const std::vector<uint8_t> joints = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
    GltfDraft absent = skinnedDraft(weights, joints), identities = absent;
    absent.root["skins"][0].erase("inverseBindMatrices");
    std::vector<float> unit(32, 0.0f);
    for (size_t i = 0; i < 8; ++i) unit[i / 4 * 16 + i % 4 * 5] = 1.0f;
    identities.root["skins"][0]["inverseBindMatrices"] = identities.addAccessor<float>("MAT4", 2, unit);
    const Result<Scene> scene = loadAt(absent, 0);
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    CHECK(scene->meshes.at(0).positions == loadAt(identities, 0)->meshes.at(0).positions);
}

TEST_CASE("a damaged skin or clip is refused") {
    const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    const Result<Scene> joint = loadAt(skinnedDraft(weights, {0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}), 0);
    REQUIRE(!joint);
    CHECK(joint.error().message.find("joint 2; skin 0 has 2") != std::string::npos);

    const std::vector<uint8_t> joints(12, 0);
    GltfDraft missing = skinnedDraft(weights, joints);
    missing.root["skins"][0]["joints"] = {1, 55};
    CHECK(!loadAt(missing, 0));
    missing.root["skins"][0]["joints"] = {1, 2, 0};
    CHECK(!loadAt(missing, 0)); // three joints, two matrices
    missing.root["nodes"][0]["skin"] = 3;
    CHECK(!loadAt(missing, 0));
    CHECK(!loadAt(skinnedDraft({-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, joints), 0));

    const auto clip = [](const std::vector<float>& times, const std::vector<float>& values, const char* path,
                         const char* interpolation = "LINEAR") {
        GltfDraft draft = triangleDraft();
        addClip(draft, "a", path, interpolation, draft.addAccessor<float>("SCALAR", times.size(), times),
                draft.addAccessor<float>("VEC3", values.size() / 3, values));
        return loadAt(draft, 0.5f);
    };
    CHECK(clip({0, 1}, {0, 0, 0, 1, 1, 1}, "translation"));
    CHECK(!clip({1, 0}, {0, 0, 0, 1, 1, 1}, "translation"));
    CHECK(!clip({0, NAN}, {0, 0, 0, 1, 1, 1}, "translation"));
    CHECK(!clip({0, 1}, {0, 0, 0}, "translation"));
    CHECK(!clip({0, 1}, {0, 0, 0, 1, 1, 1}, "rotation"));
    CHECK(!clip({0, 1}, {0, 0, 0, 1, 1, 1}, "colour"));
    CHECK(!clip({0, 1}, {0, 0, 0, 1, 1, 1}, "weights"));
    CHECK(!clip({0, 1}, {0, 0, 0, 1, 1, 1}, "translation", "CUBICSPLINE"));
    CHECK(!clip({0, 1}, {0, 0, 0, 1, 1, 1}, "translation", "BEZIER"));
}

} // namespace
} // namespace rebound::lab::test
