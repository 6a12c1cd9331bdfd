// SPDX-License-Identifier: MIT
#include "lab/scenes/scene_files.hpp"
#include "lab/sequences/motion_path.hpp"
#include "temporary_folder.hpp"

#include <doctest/doctest.h>

namespace rebound::lab {
namespace {

MotionPath parsed(const std::string& text) {
    auto path = parsePath(text, "path.json");
    REQUIRE_MESSAGE(path, (path ? "" : path.error().message));
    return *std::move(path);
}

// Keys at 0, 1, 2 and 4 s whose x is the square of time, and y its double.
std::string parabola(const std::string& interpolation) {
    return R"({"interpolation": ")" + interpolation + R"(", "camera": [
        {"time_s": 0, "position": [0, 0, 9], "target": [0, 0, 0]},
        {"time_s": 1, "position": [1, 2, 9], "target": [0, 0, 0]},
        {"time_s": 2, "position": [4, 4, 9], "target": [0, 0, 0]},
        {"time_s": 4, "position": [16, 8, 9], "target": [0, 0, 0], "vfov_degrees": 30}]})";
}

TEST_CASE("a path goes through its keys, and stands still before and after them") {
    for (const char* interpolation : {"smooth", "linear"}) {
        const MotionPath path = parsed(parabola(interpolation));
        for (const auto& [time, x] : {std::pair{-3.0, 0.0f}, std::pair{0.0, 0.0f}, std::pair{1.0, 1.0f},
                                      std::pair{2.0, 4.0f}, std::pair{4.0, 16.0f}, std::pair{9.0, 16.0f}})
            CHECK(cameraAt(path, {}, time).position.x == doctest::Approx(x));
        // What is linear stays linear in either.
        CHECK(cameraAt(path, {}, 1.5).position.y == doctest::Approx(3.0));
        CHECK(cameraAt(path, {}, 3.0).position.y == doctest::Approx(6.0));
    }
}

TEST_CASE("between keys, smooth is the spline whose slopes are those between neighbours") {
    // From 1 at slope (4 - 0) / 2 to 4 at slope (16 - 1) / 3, half way: (1 + 4) / 2 + (2 - 5) / 8.
    CHECK(cameraAt(parsed(parabola("smooth")), {}, 1.5).position.x == doctest::Approx(2.5 - 3.0 / 8.0));
    CHECK(cameraAt(parsed(parabola("linear")), {}, 1.5).position.x == doctest::Approx(2.5));
}

TEST_CASE("the speed does not jump at a key") {
    const MotionPath path = parsed(parabola("smooth"));
    const auto x = [&](double time) { return double(cameraAt(path, {}, time).position.x); };
    constexpr double h = 1e-3;
    CHECK((x(2.0 + h) - x(2.0)) / h == doctest::Approx((x(2.0) - x(2.0 - h)) / h).epsilon(0.01));
}

TEST_CASE("what a path leaves out is the camera's own") {
    CameraView camera;
    camera.verticalFieldOfView = 0.5f;
    camera.nearPlane = 0.2f;
    const MotionPath path = parsed(parabola("linear"));
    CHECK(cameraAt(path, camera, 0.0).verticalFieldOfView == 0.5f);
    CHECK(cameraAt(path, camera, 4.0).verticalFieldOfView == doctest::Approx(glm::radians(30.0f)));
    CHECK(cameraAt(path, camera, 1.0).nearPlane == 0.2f);
    CHECK(cameraAt(MotionPath{}, camera, 1.0).position == camera.position);
}

TEST_CASE("objects turn about their pivot, then move") {
    const MotionPath path =
        parsed(R"({"interpolation": "linear", "objects": {"door": {"pivot": [1, 0, 0], "axis": [0, 2, 0],
        "keys": [{"time_s": 0}, {"time_s": 2, "degrees": 180, "translation": [0, 0, 4]}]}}})");
    const auto moved = [&](double time, glm::vec3 point) {
        return glm::vec3(placeAt(path, path.objects[0], time) * glm::vec4(point, 1.0f));
    };
    CHECK(glm::length(moved(0.0, {2, 5, 0}) - glm::vec3(2, 5, 0)) < 1e-6f);
    CHECK(glm::length(moved(1.0, {1, 0, 0}) - glm::vec3(1, 0, 2)) < 1e-6f);
    // A quarter turn about y takes x to -z.
    CHECK(glm::length(moved(1.0, {2, 5, 0}) - glm::vec3(1, 5, 1)) < 1e-6f);
    CHECK(glm::length(moved(2.0, {2, 5, 0}) - glm::vec3(0, 5, 4)) < 1e-5f);
}

struct BadPath {
    const char* text;
    std::initializer_list<const char*> says;
};

TEST_CASE("bad paths are refused in one sentence with place, value and what was expected") {
    const BadPath all[] = {
        {"", {"it is not a path"}},
        {"{}", {"moves nothing", "camera"}},
        {R"({"camera": []})", {"camera is []"}},
        {R"({"camera": [{"time_s": 0, "position": [0, 0, 1]}]})", {"camera[0].target is missing"}},
        {R"({"camera": [{"position": [0, 0, 1], "target": [0, 0, 0]}]})", {"camera[0].time_s is missing"}},
        {R"({"camera": [{"time_s": 1, "position": [0, 0, 1], "target": [0, 0, 0]},
                        {"time_s": 1, "position": [0, 0, 2], "target": [0, 0, 0]}]})",
         {"camera[1].time_s is 1", "after the key before"}},
        {R"({"camera": [{"time_s": 0, "position": [0, 0], "target": [0, 0, 0]}]})",
         {"camera[0].position is [0,0]", "three numbers"}},
        {R"({"camera": [{"time_s": 0, "position": [0, 1e30, 0], "target": [0, 0, 0]}]})",
         {"camera[0].position[1] is 1e+30"}},
        {R"({"camera": [{"time_s": 0, "position": [0, 0, 0], "target": [0, 0, 0]}]})",
         {"camera[0]", "same point"}},
        {R"({"camera": [{"time_s": 0, "position": [0, 0, 1], "target": [0, 0, 0], "vfov_degrees": 180}]})",
         {"vfov_degrees is 180", "179"}},
        {R"({"camera": [{"time_s": 0, "position": [0, 0, 1], "target": [0, 0, 0], "roll": 1}]})",
         {"\"roll\"", "target"}},
        {R"({"interpolation": "cubic", "camera": []})", {"interpolation is \"cubic\"", "linear"}},
        {R"({"objects": {"door": {}}})", {"objects.door.keys is missing"}},
        {R"({"objects": {"door": {"axis": [0, 0, 0], "keys": [{"time_s": 0}]}}})",
         {"objects.door.axis", "not zero"}},
        {R"({"objects": {"door": {"keys": [{"time_s": 2}, {"time_s": -1}]}}})",
         {"objects.door.keys[1].time_s is -1"}},
        {R"({"objects": [1]})", {"objects is [1]", "an object"}},
    };
    for (const auto& [text, says] : all) {
        INFO("path: ", text);
        const auto path = parsePath(text, "path.json");
        REQUIRE(!path);
        INFO("it says: ", path.error().message);
        CHECK(path.error().message.find("path.json") != std::string::npos);
        CHECK(path.error().message.find('\n') == std::string::npos);
        for (const char* part : says) CHECK(path.error().message.find(part) != std::string::npos);
    }
    const TemporaryFolder folder;
    const auto missing = readPath(folder / "missing.json");
    REQUIRE(!missing);
    CHECK(missing.error().message.find("missing.json") != std::string::npos);
}

TEST_CASE("each built-in scene has a path whose objects it has") {
    for (const std::string& name : builtinScenes()) {
        CAPTURE(name);
        const auto path = builtinPath(name);
        REQUIRE(path);
        CHECK(path->camera.size() >= 3);
        SceneMoment moment;
        for (const ObjectPath& object : path->objects)
            moment.moved[object.name] = placeAt(*path, object, 1.0);
        CHECK(!moment.moved.empty());
        const auto scene = loadScene(name, {}, moment);
        CHECK_MESSAGE(scene, (scene ? "" : scene.error().message));
    }
    CHECK(!builtinPath("scene.gltf"));
}

} // namespace
} // namespace rebound::lab
