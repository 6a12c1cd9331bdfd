// SPDX-License-Identifier: MIT
#include "frame_test_scene.hpp"

#include <algorithm>

using namespace rebound;
using namespace rebound::lab;

namespace {

// A float's rounding of a few operations, relative to the distances involved.
constexpr double rounding = 2e-6;

// A tilted plane that fills the view of obliqueCamera().
Scene tiltedPlane(glm::vec3& normal) {
    Scene scene;
    addMaterial(scene, {0.2f, 0.4f, 0.8f});
    const glm::vec3 a(50, 10, 5);
    const glm::vec3 b(-8, 40, 20);
    normal = glm::normalize(glm::cross(a, b));
    addQuad(scene, {0, 0, -10}, a, b);
    return scene;
}

CameraView obliqueCamera() {
    CameraView camera;
    camera.position = {1, 2, 3};
    camera.target = {0.5f, 1.0f, -4.0f};
    camera.up = {0.1f, 1.0f, 0.0f};
    camera.verticalFieldOfView = 0.9f;
    return camera;
}

} // namespace

TEST_CASE("depth along the viewing axis leads back to the surface") {
    glm::vec3 normal;
    const Scene scene = tiltedPlane(normal);
    const Frame frame = rendered(scene, obliqueCamera(), {.extent = {31, 17}, .threads = 1});
    REQUIRE(validate(frame));
    double worst = 0.0;
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 31; ++x) {
            REQUIRE(*frame.depth.at(x, y) > 0.0f);
            const glm::dvec3 onPlane = positionAt(frame, x, y) - glm::dvec3(0, 0, -10);
            worst = std::max(worst, std::abs(glm::dot(onPlane, glm::dvec3(normal))));
        }
    CHECK(worst < rounding * 20.0); // the plane is up to 20 m away
}

TEST_CASE("normals are of unit length and turned towards the camera from either side") {
    glm::vec3 normal;
    Scene scene = tiltedPlane(normal);
    for (const float side : {1.0f, -1.0f}) {
        for (glm::vec3& n : scene.meshes[0].normals) n = side * normal;
        const Frame frame = rendered(scene, obliqueCamera(), {.extent = {8, 8}, .threads = 1});
        const glm::vec3 seen = colorAt(frame.normal, 3, 4);
        const bool faces =
            glm::dot(normal, glm::vec3(positionAt(frame, 3, 4)) - obliqueCamera().position) < 0.0f;
        CHECK(glm::length(seen - (faces ? normal : -normal)) < 1e-6f);
        CHECK(glm::length(colorAt(frame.albedo, 3, 4) - glm::vec3(0.2f, 0.4f, 0.8f)) < 1e-6f);
    }
}

TEST_CASE("vertex normals are interpolated") {
    Scene scene = floorScene(1.0f);
    const glm::vec3 left = glm::normalize(glm::vec3(-1, 1, 0));
    const glm::vec3 right = glm::normalize(glm::vec3(1, 1, 0));
    Mesh& mesh = scene.meshes[0];
    for (size_t i = 0; i < 4; ++i) mesh.normals[i] = mesh.positions[i].x < 0 ? left : right;
    const Frame frame = rendered(scene, downCamera(), {.extent = {9, 9}, .threads = 1});
    // A linear blend across x: at the centre it is straight up, at x it leans by x / 1 m.
    CHECK(glm::length(colorAt(frame.normal, 4, 4) - glm::vec3(0, 1, 0)) < 1e-5f);
    const double x = positionAt(frame, 7, 2).x;
    CHECK(glm::length(colorAt(frame.normal, 7, 2) - glm::normalize(glm::vec3(float(x), 1.0f, 0.0f))) < 1e-5f);
}

TEST_CASE("pixels that see nothing are zero everywhere") {
    Scene scene = floorScene(0.5f);
    scene.environment = glm::vec3(3.0f);
    scene.lights.push_back({});
    const Frame frame = rendered(scene, downCamera(), {.extent = {16, 16}, .threads = 1});
    CHECK(*frame.depth.at(8, 8) == doctest::Approx(2.0));
    for (const Image* image : {&frame.depth, &frame.normal, &frame.albedo, &frame.direct})
        CHECK(*image->at(0, 0) == 0.0f);
    CHECK(frame.emission.empty());
}

TEST_CASE("near and far planes cut along the viewing axis") {
    Scene scene = floorScene();
    addQuad(scene, {0, 1, 0}, {0, 0, 100}, {100, 0, 0});
    CameraView camera = downCamera(2.0f, 1.5f);
    const FrameOptions options{.extent = {9, 9}, .threads = 1};
    CHECK(*rendered(scene, camera, options).depth.at(0, 0) == doctest::Approx(1.0));
    // A corner's ray is 1.6 times as long as its depth, so that a cut along the ray would fail here.
    camera.nearPlane = 1.01f;
    CHECK(*rendered(scene, camera, options).depth.at(0, 0) == doctest::Approx(2.0));
    camera.farPlane = 1.99f;
    CHECK(*rendered(scene, camera, options).depth.at(0, 0) == 0.0f);
}

TEST_CASE("an orthographic camera sees parallel rays") {
    Scene scene = floorScene(1.0f);
    addQuad(scene, {0.5f, 0.25f, -0.5f}, {0, 0, 0.5f}, {0.5f, 0, 0}, addMaterial(scene, {1, 0, 0}));
    CameraView camera = downCamera();
    camera.orthographic = true;
    camera.orthographicHeight = 2.0f;
    const Frame frame = rendered(scene, camera, {.extent = {40, 20}, .threads = 1});
    // 4 m by 2 m in pixels of 0.1 m: the floor covers columns 10 to 29; the raised quad their upper right
    // quarter.
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x) {
            const bool floor = x >= 10 && x < 30;
            const bool raised = x >= 20 && x < 30 && y < 10;
            CHECK(*frame.depth.at(x, y) == doctest::Approx(raised  ? 1.75
                                                           : floor ? 2.0
                                                                   : 0.0)
                                               .epsilon(rounding));
            CHECK(frame.albedo.at(x, y)[0] == (raised ? 1.0f : floor ? 0.5f : 0.0f));
        }
}

TEST_CASE("textures are placed, wrapped, filtered and decoded") {
    Scene scene = floorScene(1.0f);
    // Red, green above blue, white; v grows downwards from the top row.
    scene.textures.push_back({"quarters",
                              2,
                              2,
                              Wrap::clamp,
                              Wrap::clamp,
                              {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 188, 188, 188, 255}});
    scene.materials[0].baseColor = glm::vec4(0.5f, 1.0f, 1.0f, 1.0f);
    scene.materials[0].baseColorTexture = 0;
    // u along world x and v along world z, both from 0 to 1.
    scene.meshes[0].textureCoordinates = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    CameraView camera = downCamera();
    camera.orthographic = true;
    camera.orthographicHeight = 2.0f;
    const FrameOptions options{.extent = {20, 20}, .threads = 1};
    Frame frame = rendered(scene, camera, options);
    CHECK(colorAt(frame.albedo, 0, 0) == glm::vec3(0.5f, 0, 0));
    CHECK(colorAt(frame.albedo, 19, 0) == glm::vec3(0, 1, 0));
    CHECK(colorAt(frame.albedo, 0, 19) == glm::vec3(0, 0, 1));
    // sRGB 188 / 255 is 0.5029 linear.
    CHECK(frame.albedo.at(19, 19)[1] == doctest::Approx(0.5029).epsilon(1e-3));
    // Pixel 9 is at u = 0.475, between texel centres 0.25 and 0.75: 0.55 of the first, 0.45 of the second.
    CHECK(frame.albedo.at(9, 0)[1] == doctest::Approx(0.45).epsilon(1e-4));
    CHECK(frame.albedo.at(9, 0)[0] == doctest::Approx(0.5 * 0.55).epsilon(1e-4));
    // Repeated, the first pixel, at u = v = 0.025, mixes with the other side: 0.275 / 0.5 of texel 0 on each
    // axis.
    scene.textures[0].wrapS = scene.textures[0].wrapT = Wrap::repeat;
    frame = rendered(scene, camera, options);
    const float own = 0.55f;
    CHECK(frame.albedo.at(0, 0)[0] ==
          doctest::Approx(0.5 * double(own * own + (1 - own) * (1 - own) * 0.5029f)).epsilon(1e-3));
    // Mirrored, both neighbours are the same texel.
    scene.textures[0].wrapS = scene.textures[0].wrapT = Wrap::mirror;
    CHECK(colorAt(rendered(scene, camera, options).albedo, 0, 0) == glm::vec3(0.5f, 0, 0));
}
