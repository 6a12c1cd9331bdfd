// SPDX-License-Identifier: MIT
#include "frame_test_scene.hpp"

#include <limits>
#include <stdexcept>

using namespace rebound;
using namespace rebound::lab;

namespace {

// Every kind of light at once, over a floor with something on it.
Scene busyScene() {
    Scene scene = floorScene(3.0f);
    addQuad(scene, {0.3f, 0.4f, 0.2f}, {0.4f, 0.1f, 0}, {0, 0.1f, 0.4f},
            addMaterial(scene, {0.8f, 0.2f, 0.1f}));
    addQuad(scene, {-0.5f, 0.3f, 0}, {0, 0.2f, 0}, {0, 0, 0.2f},
            addMaterial(scene, glm::vec3(0.1f), {3, 2, 1}));
    for (const LightType type :
         {LightType::directional, LightType::point, LightType::spot, LightType::area}) {
        Light light;
        light.type = type;
        light.position = {0.2f, 1.5f, 0.4f};
        scene.lights.push_back(light);
    }
    scene.environment = {0.1f, 0.2f, 0.3f};
    return scene;
}

} // namespace

TEST_CASE("any number of threads gives the same bits") {
    const Scene scene = busyScene();
    const Frame one = rendered(scene, downCamera(), {.extent = {37, 29}, .lightSamples = 5, .threads = 1});
    for (const int threads : {0, 2, 5, 64}) {
        const Frame many =
            rendered(scene, downCamera(), {.extent = {37, 29}, .lightSamples = 5, .threads = threads});
        CHECK(many.depth.data == one.depth.data);
        CHECK(many.normal.data == one.normal.data);
        CHECK(many.albedo.data == one.albedo.data);
        CHECK(many.direct.data == one.direct.data);
        CHECK(many.emission.data == one.emission.data);
    }
}

TEST_CASE("progress rises to 1, one call at a time") {
    double last = 0.0;
    bool rising = true;
    const FrameOptions options{
        .extent = {16, 33}, .lightSamples = 1, .threads = 3, .progress = [&](double share) {
            rising = rising && share > last;
            last = share;
        }};
    rendered(busyScene(), downCamera(), options);
    CHECK(rising);
    CHECK(last == 1.0);
}

TEST_CASE("what a progress callback throws reaches the caller") {
    const FrameOptions options{.extent = {16, 33}, .lightSamples = 1, .threads = 3, .progress = [](double) {
                                   throw std::runtime_error("stop");
                               }};
    CHECK_THROWS_AS((void)renderFrame(busyScene(), downCamera(), options), std::runtime_error);
}

TEST_CASE("options out of range are named") {
    const Scene scene = busyScene();
    const auto message = [&](const FrameOptions& options) {
        const auto frame = renderFrame(scene, downCamera(), options);
        REQUIRE(!frame);
        CHECK(frame.error().code == ErrorCode::invalidArgument);
        return frame.error().message;
    };
    CHECK(message({.extent = {0, 5}}).find("extent.width is 0") != std::string::npos);
    CHECK(message({.extent = {5, maximumExtent + 1}}).find("extent.height is 16385") != std::string::npos);
    CHECK(message({.extent = {5, 5}, .lightSamples = 0}).find("lightSamples is 0") != std::string::npos);
    CHECK(message({.extent = {5, 5}, .threads = -1}).find("threads is -1") != std::string::npos);
}

TEST_CASE("cameras that see no image are refused") {
    const Scene scene = busyScene();
    const float notANumber = std::numeric_limits<float>::quiet_NaN();
    std::vector<CameraView> cameras(9, downCamera());
    cameras[0].target = cameras[0].position;
    cameras[1].up = {0, 3, 0};
    cameras[2].up = glm::vec3(0.0f);
    cameras[3].verticalFieldOfView = 0.0f;
    cameras[4].verticalFieldOfView = 3.2f;
    cameras[5].nearPlane = cameras[5].farPlane;
    cameras[6].position.x = notANumber;
    cameras[7].orthographic = true;
    cameras[7].orthographicHeight = 0.0f;
    cameras[8].farPlane = notANumber;
    for (const CameraView& camera : cameras) {
        const auto frame = renderFrame(scene, camera, {.extent = {4, 4}});
        REQUIRE(!frame);
        CHECK(frame.error().message.find("camera \"down\"") != std::string::npos);
    }
}

TEST_CASE("an invalid scene is refused") {
    Scene scene = floorScene();
    scene.meshes[0].indices[4] = 9;
    CHECK_FALSE(renderFrame(scene, downCamera(), {.extent = {4, 4}}));
    CHECK_FALSE(renderFrame(Scene(), downCamera(), {.extent = {4, 4}}));
}

TEST_CASE("triangles without area and meshes without triangles are passed over") {
    Scene scene = busyScene();
    Mesh flat = scene.meshes[2]; // emissive
    flat.positions.assign(4, glm::vec3(0.1f, 0.2f, 0.3f));
    scene.meshes.push_back(flat);
    scene.meshes.push_back({});
    scene.meshes.back().material = 0;
    const Frame frame = rendered(scene, downCamera(), {.extent = {16, 16}, .lightSamples = 4, .threads = 1});
    const Frame without =
        rendered(busyScene(), downCamera(), {.extent = {16, 16}, .lightSamples = 4, .threads = 1});
    CHECK(frame.direct.data == without.direct.data);
}
