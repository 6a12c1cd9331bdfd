// SPDX-License-Identifier: MIT
#include "gltf_draft.hpp"

#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <numbers>

namespace rebound::lab::test {
namespace {

// Rounding of a few single operations on numbers of about 1.
constexpr float rounding = 1e-6f;

Json goodView() {
    return Json::parse(R"({
        "cameras": [{"name": "front", "position": [0, 1, 5], "target": [0, 1, 0], "up": [0, 1, 0],
                     "vfov_degrees": 90, "near": 0.1, "far": 50}],
        "lights": [
            {"type": "directional", "direction": [0, -2, 0], "color": [1, 0.5, 0.25], "intensity": 8},
            {"type": "point", "position": [1, 2, 3], "color": [1, 1, 1], "intensity": 2},
            {"type": "spot", "position": [1, 2, 3], "direction": [3, 0, 4], "color": [1, 1, 1], "intensity": 2,
             "cone_degrees": 60},
            {"type": "area", "position": [0, 5, 0], "direction": [0, -3, 0], "right": [2, 1, 0], "size": [1.5, 2.5],
             "color": [1, 1, 1], "intensity": 12}],
        "environment": {"type": "constant", "radiance": [0.1, 0.2, 0.3]},
        "emissive_materials": false,
        "animation": {"name": "Walk", "time_s": 0.35},
        "units": {}})");
}

Result<> applyView(const std::string& text, Scene& scene) {
    TemporaryFolder folder;
    writeText(folder / "a_view.json", text);
    const Result<ViewFile> view = readViewFile(folder / "a_view.json");
    if (!view) return view.error();
    applyViewFile(*view, scene);
    return {};
}

TEST_CASE("a view file's lights, camera, environment and animation") {
    Scene scene;
    scene.cameras.emplace_back();
    scene.lights.emplace_back();
    REQUIRE(applyView(goodView().dump(), scene));
    REQUIRE(scene.cameras.size() == 1);
    CHECK(scene.cameras[0].name == "front");
    CHECK(scene.cameras[0].position == glm::vec3(0, 1, 5));
    CHECK(std::abs(scene.cameras[0].verticalFieldOfView - std::numbers::pi_v<float> / 2) <= rounding);
    CHECK(scene.cameras[0].nearPlane == 0.1f);
    CHECK(scene.environment == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(!scene.emissiveMaterialsLight);

    REQUIRE(scene.lights.size() == 4);
    CHECK(scene.lights[0].type == LightType::directional);
    CHECK(scene.lights[0].direction == glm::vec3(0, -1, 0));
    CHECK(scene.lights[0].intensity == glm::vec3(8, 4, 2));
    CHECK(scene.lights[1].type == LightType::point);
    CHECK(scene.lights[1].position == glm::vec3(1, 2, 3));
    const Light& spot = scene.lights[2];
    CHECK(spot.type == LightType::spot);
    CHECK(glm::distance(spot.direction, glm::vec3(0.6f, 0, 0.8f)) <= rounding);
    // The file's angle is the full one.
    CHECK(std::abs(spot.outerCone - std::numbers::pi_v<float> / 6) <= rounding);
    CHECK(spot.innerCone == spot.outerCone);
    const Light& area = scene.lights[3];
    CHECK(area.type == LightType::area);
    CHECK(area.direction == glm::vec3(0, -1, 0));
    CHECK(glm::distance(area.right, glm::vec3(1, 0, 0)) <= rounding);
    CHECK(area.size == glm::vec2(1.5f, 2.5f));
}

TEST_CASE("what a view file does not hold stays the scene's, and what no view file holds is noted") {
    Scene before;
    before.cameras.resize(2);
    before.lights.resize(3);
    before.environment = {1, 2, 3};
    before.emissiveMaterialsLight = false;
    Scene scene = before;
    REQUIRE(applyView("{}", scene));
    CHECK(scene.cameras.size() == 2);
    CHECK(scene.lights.size() == 3);
    CHECK(scene.environment == glm::vec3(1, 2, 3));
    CHECK_FALSE(scene.emissiveMaterialsLight);
    CHECK(scene.notes.empty());
    REQUIRE(applyView(R"({"enviroment": {}, "lights": []})", scene));
    CHECK(scene.cameras.size() == 2);
    CHECK(scene.lights.empty());
    REQUIRE(scene.notes.size() == 1);
    CHECK(scene.notes[0].find("\"enviroment\"") != std::string::npos);
}

TEST_CASE("the moment that a view file asks for") {
    TemporaryFolder folder;
    writeText(folder / "view.json", goodView().dump());
    const Result<ViewFile> view = readViewFile(folder / "view.json");
    REQUIRE(view);
    CHECK(view->animation.animate);
    CHECK(view->animation.animation == "Walk");
    CHECK(view->animation.time == 0.35f);
    Json still = goodView();
    still.erase("animation");
    writeText(folder / "view.json", still.dump());
    CHECK(!readViewFile(folder / "view.json")->animation.animate);
    for (const char* animation :
         {"3", "{}", R"({"name": "a"})", R"({"name": 1, "time_s": 0})", R"({"name": "a", "time_s": "x"})"}) {
        CAPTURE(animation);
        writeText(folder / "view.json", std::string("{\"animation\": ") + animation + "}");
        CHECK(!readViewFile(folder / "view.json"));
    }
}

struct Damage {
    const char* name;
    std::function<void(Json&)> apply;
    const char* expected; // part of the message
};

const Damage damages[] = {
    {"cameras are no list", [](Json& v) { v["cameras"] = 1; }, "cameras"},
    {"camera is no object", [](Json& v) { v["cameras"][0] = 1; }, "cameras[0]"},
    {"camera without a name", [](Json& v) { v["cameras"][0].erase("name"); }, "name"},
    {"camera with an empty name", [](Json& v) { v["cameras"][0]["name"] = ""; }, "name"},
    {"camera without a position", [](Json& v) { v["cameras"][0].erase("position"); }, "position"},
    {"camera at its target",
     [](Json& v) {
         v["cameras"][0]["target"] = {0, 1, 5};
     },
     "cameras[0]"},
    {"field of view of 180", [](Json& v) { v["cameras"][0]["vfov_degrees"] = 180; }, "cameras[0]"},
    {"far before near", [](Json& v) { v["cameras"][0]["far"] = 0.01; }, "cameras[0]"},
    {"light is no object", [](Json& v) { v["lights"][1] = "sun"; }, "lights[1]"},
    {"light without a type", [](Json& v) { v["lights"][1].erase("type"); }, "type"},
    {"unknown light", [](Json& v) { v["lights"][1]["type"] = "laser"; }, "laser"},
    {"no intensity", [](Json& v) { v["lights"][0].erase("intensity"); }, "intensity"},
    {"intensity as text", [](Json& v) { v["lights"][0]["intensity"] = "8"; }, "intensity"},
    {"negative intensity", [](Json& v) { v["lights"][0]["intensity"] = -8; }, "intensity"},
    {"intensity beyond floats", [](Json& v) { v["lights"][0]["intensity"] = 1e300; }, "intensity"},
    {"product beyond floats",
     [](Json& v) {
         v["lights"][0]["intensity"] = 1e30;
         v["lights"][0]["color"] = {1e30, 1, 1};
     },
     "intensity"},
    {"colour of two",
     [](Json& v) {
         v["lights"][0]["color"] = {1, 1};
     },
     "color"},
    {"no direction", [](Json& v) { v["lights"][0].erase("direction"); }, "direction"},
    {"zero direction",
     [](Json& v) {
         v["lights"][0]["direction"] = {0, 0, 0};
     },
     "direction"},
    {"null in a direction",
     [](Json& v) {
         v["lights"][0]["direction"] = {0, nullptr, 0};
     },
     "direction"},
    {"no position", [](Json& v) { v["lights"][1].erase("position"); }, "position"},
    {"no cone", [](Json& v) { v["lights"][2].erase("cone_degrees"); }, "cone_degrees"},
    {"cone of 0", [](Json& v) { v["lights"][2]["cone_degrees"] = 0; }, "cone_degrees"},
    {"cone of 270", [](Json& v) { v["lights"][2]["cone_degrees"] = 270; }, "cone_degrees"},
    {"no size", [](Json& v) { v["lights"][3].erase("size"); }, "size"},
    {"size of 0",
     [](Json& v) {
         v["lights"][3]["size"] = {0, 1};
     },
     "size"},
    {"right along the direction",
     [](Json& v) {
         v["lights"][3]["right"] = {0, 4, 0};
     },
     "right"},
    {"unknown environment", [](Json& v) { v["environment"]["type"] = "map"; }, "map"},
    {"negative environment",
     [](Json& v) {
         v["environment"]["radiance"] = {0, -1, 0};
     },
     "radiance"},
    {"flag as a number", [](Json& v) { v["emissive_materials"] = 1; }, "emissive_materials"},
};

TEST_CASE("a damaged view file is refused with the file and the key, and the scene stays as it was") {
    for (const Damage& damage : damages) {
        CAPTURE(damage.name);
        Json view = goodView();
        damage.apply(view);
        Scene scene;
        scene.environment = glm::vec3(7.0f);
        const Result<> applied = applyView(view.dump(), scene);
        REQUIRE(!applied);
        INFO(applied.error().message);
        CHECK(applied.error().message.find("a_view.json") != std::string::npos);
        CHECK(applied.error().message.find(damage.expected) != std::string::npos);
        CHECK(scene.environment == glm::vec3(7.0f));
        CHECK(scene.lights.empty());
        CHECK(scene.cameras.empty());
    }
}

TEST_CASE("what is no view file is refused") {
    Scene scene;
    for (const char* text : {"", "[]", "{", "{\"cameras\": [NaN]}", "\xff"}) CHECK(!applyView(text, scene));
    CHECK(!applyView(R"({"lights": [{"type": "point", "intensity": 1e999}]})", scene));
    // Nested deeper than a stack.
    const Result<> deep = applyView(
        "{\"lights\": [{\"type\": " + std::string(1000000, '[') + std::string(1000000, ']') + "}]}", scene);
    REQUIRE(!deep);
    CHECK(deep.error().message.find("nested deeper than 64") != std::string::npos);
    TemporaryFolder folder;
    CHECK(readViewFile(folder / "none.json").error().code == ErrorCode::notFound);
    CHECK(!readViewFile(folder / ""));
}

} // namespace
} // namespace rebound::lab::test
