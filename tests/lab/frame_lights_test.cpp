// SPDX-License-Identifier: MIT
// Direct light against closed forms. Frames hold irradiance / pi.
#include "frame_test_scene.hpp"

#include <array>
#include <numbers>

using namespace rebound;
using namespace rebound::lab;

namespace {

constexpr double pi = std::numbers::pi;

// Light without area is exact but for the rounding of floats.
constexpr double exact = 1e-5;

// 4096 stratified samples of a smooth integrand: far better than the 1.6 % of independent ones.
constexpr int manySamples = 4096;
constexpr double sampled = 2e-3;

Light lightOf(LightType type, glm::vec3 intensity) {
    Light light;
    light.type = type;
    light.intensity = intensity;
    return light;
}

// Irradiance on the floor seen by pixel (x, y), per unit of the red channel.
double irradiance(const Frame& frame, int x, int y) { return pi * double(*frame.direct.at(x, y)); }

} // namespace

TEST_CASE("directional light falls with the cosine") {
    Scene scene = floorScene();
    for (const double angle : {0.0, 0.5, 1.2, 1.7}) {
        scene.lights = {lightOf(LightType::directional, {5, 3, 1})};
        scene.lights[0].direction = {float(std::sin(angle)), float(-std::cos(angle)), 0};
        const Frame frame = rendered(scene, downCamera(), {.extent = {4, 4}, .threads = 1});
        const double cosine = std::max(0.0, std::cos(angle));
        CHECK(irradiance(frame, 1, 2) == doctest::Approx(5 * cosine).epsilon(exact));
        CHECK(frame.direct.at(3, 0)[2] * 5.0f == doctest::Approx(frame.direct.at(3, 0)[0]));
    }
}

TEST_CASE("a point light falls with cos / d^2") {
    Scene scene = floorScene();
    scene.lights = {lightOf(LightType::point, glm::vec3(7.0f))};
    scene.lights[0].position = {0.3f, 0.8f, -0.2f};
    const Frame frame = rendered(scene, downCamera(), {.extent = {9, 7}, .threads = 1});
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x) {
            const glm::dvec3 towards = glm::dvec3(scene.lights[0].position) - positionAt(frame, x, y);
            const double d = glm::length(towards);
            CHECK(irradiance(frame, x, y) == doctest::Approx(7 * towards.y / (d * d * d)).epsilon(exact));
        }
}

TEST_CASE("a spot light ends at its cone, hard or soft") {
    Scene scene = floorScene();
    Light spot = lightOf(LightType::spot, glm::vec3(4.0f));
    spot.position = {0, 1, 0};
    spot.direction = {0, -1, 0};
    for (const float inner : {0.4f, 0.2f}) {
        spot.outerCone = 0.4f;
        spot.innerCone = inner;
        scene.lights = {spot};
        const Frame frame = rendered(scene, downCamera(), {.extent = {41, 41}, .threads = 1});
        int dark = 0;
        int full = 0;
        for (int x = 0; x < 41; ++x) {
            const glm::dvec3 p = positionAt(frame, x, 20);
            const double angle = std::atan(std::hypot(p.x, p.z));
            const double cosine = std::cos(angle);
            const double ramp = (cosine - std::cos(0.4)) / (std::cos(double(inner)) - std::cos(0.4));
            const double share = angle > 0.4 ? 0.0 : angle < double(inner) ? 1.0 : ramp * ramp;
            dark += share == 0.0;
            full += share == 1.0;
            // The irradiance of a point light 1 m above the floor is I cos^3; the ramp divides differences of
            // cosines.
            CHECK(irradiance(frame, x, 20) == doctest::Approx(4 * share * std::pow(cosine, 3)).epsilon(1e-4));
        }
        CHECK(dark > 5);
        CHECK(full > 5);
    }
}

TEST_CASE("a square above a parallel floor") {
    Scene scene = floorScene();
    Light area = lightOf(LightType::area, glm::vec3(3.0f));
    area.position = {0, 1, 0};
    area.direction = {0, -1, 0};
    area.size = {1.2f, 1.2f};
    scene.lights = {area};
    CameraView camera = downCamera(0.9f, 0.02f); // beneath the light, which no camera sees
    const Frame frame =
        rendered(scene, camera, {.extent = {1, 1}, .lightSamples = manySamples, .threads = 1});
    // Four corner rectangles of sides 0.6 at distance 1: 4 * (s / sqrt(1 + s^2)) atan(s / sqrt(1 + s^2)).
    const double k = 0.6 / std::sqrt(1.0 + 0.6 * 0.6);
    CHECK(irradiance(frame, 0, 0) == doctest::Approx(3 * 4 * k * std::atan(k)).epsilon(sampled));
}

TEST_CASE("an area light by Lambert's formula, and nothing behind it") {
    Scene scene = floorScene();
    Light area = lightOf(LightType::area, {2, 0, 0});
    area.position = {0.4f, 1.3f, -0.3f};
    area.direction = glm::normalize(glm::vec3(-0.3f, -1.0f, 0.2f));
    area.right = glm::normalize(glm::cross(area.direction, glm::vec3(0, 0, 1)));
    area.size = {0.9f, 0.5f};
    scene.lights = {area};
    const FrameOptions options{.extent = {5, 5}, .lightSamples = manySamples, .threads = 1};
    const Frame frame = rendered(scene, downCamera(), options);
    const glm::dvec3 r = glm::dvec3(area.right) * 0.45;
    const glm::dvec3 u = glm::cross(glm::dvec3(area.direction), glm::dvec3(area.right)) * 0.25;
    const glm::dvec3 c = area.position;
    const std::array corners{c - r - u, c + r - u, c + r + u, c - r + u};
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x)
            CHECK(irradiance(frame, x, y) ==
                  doctest::Approx(2 * lambert(corners, positionAt(frame, x, y), {0, 1, 0})).epsilon(sampled));
    scene.lights[0].direction = -area.direction;
    CHECK(irradiance(rendered(scene, downCamera(), options), 2, 2) == 0.0);
}

TEST_CASE("an emissive triangle lights from both sides, by Lambert's formula") {
    Scene scene = floorScene();
    const int lamp = addMaterial(scene, glm::vec3(0.0f), {6, 1, 0.5f});
    Mesh triangle;
    triangle.material = lamp;
    triangle.positions = {{-0.5f, 1.0f, -0.4f}, {0.6f, 1.2f, 0.1f}, {0.1f, 0.9f, 0.7f}};
    triangle.indices = {0, 1, 2};
    triangle.normals.assign(3, glm::normalize(glm::cross(triangle.positions[1] - triangle.positions[0],
                                                         triangle.positions[2] - triangle.positions[0])));
    scene.meshes.push_back(triangle);
    CameraView camera = downCamera(0.5f);
    camera.position.y = 0.4f;
    const FrameOptions options{.extent = {5, 5}, .lightSamples = manySamples, .threads = 1};
    const std::array<glm::dvec3, 3> corners{triangle.positions[0], triangle.positions[1],
                                            triangle.positions[2]};
    for (const bool flipped : {false, true}) {
        if (flipped) std::swap(scene.meshes[1].indices[1], scene.meshes[1].indices[2]);
        const Frame frame = rendered(scene, camera, options);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 5; ++x)
                CHECK(irradiance(frame, x, y) ==
                      doctest::Approx(6 * lambert(corners, positionAt(frame, x, y), {0, 1, 0}))
                          .epsilon(sampled));
    }
    scene.emissiveMaterialsLight = false;
    CHECK(irradiance(rendered(scene, camera, options), 2, 2) == 0.0);
}

TEST_CASE("a small emitter near the origin lights a floor far away without loss") {
    Scene scene;
    addMaterial(scene, glm::vec3(0.5f));
    addQuad(scene, {0, -20, 0}, {0, 0, 100}, {100, 0, 0});
    const int lamp = addMaterial(scene, glm::vec3(0.0f), glm::vec3(1e4f));
    // Tilted, so that rounding puts samples on either side of the plane.
    const glm::vec3 a(0.03f, 0.011f, 0.007f);
    const glm::vec3 b(-0.009f, 0.013f, 0.031f);
    addQuad(scene, {0.02f, 0.01f, -0.03f}, a, b, lamp);
    CameraView camera = downCamera(2.0f, 1.2f);
    camera.position.y = -15.0f;
    camera.target.y = -20.0f;
    const Frame frame = rendered(scene, camera, {.extent = {5, 5}, .lightSamples = 1024, .threads = 1});
    const glm::dvec3 c(0.02f, 0.01f, -0.03f);
    const glm::dvec3 da(a);
    const glm::dvec3 db(b);
    const std::array<glm::dvec3, 4> corners{c - da - db, c + da - db, c + da + db, c - da + db};
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x)
            CHECK(
                irradiance(frame, x, y) ==
                doctest::Approx(1e4 * lambert(corners, positionAt(frame, x, y), {0, 1, 0})).epsilon(sampled));
}

TEST_CASE("a textured emitter lights as its texels do, and only through what is not cut out") {
    Scene scene = floorScene();
    Material lamp;
    lamp.baseColor = glm::vec4(0, 0, 0, 1);
    lamp.emission = glm::vec3(5.0f);
    lamp.emissionTexture = 0;
    scene.materials.push_back(lamp);
    // The left column glows, the right one does not.
    scene.textures.push_back({"half", 64, 1, Wrap::clamp, Wrap::clamp, std::vector<uint8_t>(64 * 4, 255)});
    for (size_t x = 32; x < 64; ++x) std::fill_n(&scene.textures[0].rgba[x * 4], 3, uint8_t{0});
    addQuad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 1);
    CameraView camera = downCamera(0.9f, 0.1f);
    const FrameOptions options{.extent = {1, 1}, .lightSamples = manySamples, .threads = 1};
    const std::array<glm::dvec3, 4> left{glm::dvec3(-1, 1, -1), {0, 1, -1}, {0, 1, 1}, {-1, 1, 1}};
    const double expected = 5 * lambert(left, {0, 0, 0}, {0, 1, 0});
    // The edge between the halves is one texel wide, 1/32 m of the 2 m, symmetric about the middle in
    // sRGB-linear light; a hard edge in the integrand halves the rate at which stratified samples converge.
    constexpr double edged = 1e-2;
    CHECK(irradiance(rendered(scene, camera, options), 0, 0) == doctest::Approx(expected).epsilon(edged));

    scene.materials[1].emissionTexture = none;
    scene.materials[1].baseColorTexture = 0;
    scene.materials[1].alphaMasked = true;
    for (size_t x = 32; x < 64; ++x) scene.textures[0].rgba[x * 4 + 3] = 0;
    CHECK(irradiance(rendered(scene, camera, options), 0, 0) == doctest::Approx(expected).epsilon(edged));
}

TEST_CASE("emission is seen where it is visible, and only then stored") {
    Scene scene = floorScene();
    const int lamp = addMaterial(scene, glm::vec3(0.25f), {6, 1, 0.5f});
    addQuad(scene, {0.5f, 0.01f, 0}, {0, 0, 0.2f}, {0.2f, 0, 0}, lamp);
    const FrameOptions options{.extent = {40, 20}, .threads = 1};
    const Frame frame = rendered(scene, downCamera(), options);
    REQUIRE(validate(frame));
    REQUIRE_FALSE(frame.emission.empty());
    CHECK(colorAt(frame.emission, 20 + 5, 10) == glm::vec3(6, 1, 0.5f));
    CHECK(colorAt(frame.emission, 5, 10) == glm::vec3(0.0f));
    CHECK(colorAt(outgoingRadiance(frame), 25, 10).x ==
          doctest::Approx(6 + 0.25 * frame.direct.at(25, 10)[0]));
    // Its light is in `direct`, and would arrive a second time if it were gathered.
    CHECK(frame.emissionIsDirectLight);
    CHECK(colorAt(gatheredRadiance(frame), 25, 10).x == 0.25f * frame.direct.at(25, 10)[0]);
    scene.emissiveMaterialsLight = false;
    const Frame gathered = rendered(scene, downCamera(), options);
    CHECK_FALSE(gathered.emissionIsDirectLight);
    CHECK(gathered.emission.data == frame.emission.data);
    for (const float value : gathered.direct.data) REQUIRE(value == 0.0f);
    CHECK(colorAt(gatheredRadiance(gathered), 25, 10) == glm::vec3(6, 1, 0.5f));
    CHECK(gatheredRadiance(gathered).data == outgoingRadiance(gathered).data);
    scene.meshes[1].positions = {{9, 1, 9}, {9, 1, 10}, {10, 1, 10}, {10, 1, 9}};
    CHECK(rendered(scene, downCamera(), options).emission.empty());
}

TEST_CASE("an open floor under a constant environment receives pi L, exactly") {
    Scene scene = floorScene();
    scene.environment = {0.7f, 2.0f, 0.0f};
    const Frame frame = rendered(scene, downCamera(), {.extent = {7, 5}, .lightSamples = 3, .threads = 1});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            CHECK(frame.direct.at(x, y)[0] == doctest::Approx(0.7).epsilon(exact));
            CHECK(frame.direct.at(x, y)[1] == doctest::Approx(2.0).epsilon(exact));
        }
}

TEST_CASE("beside a wall without end, half of the environment is left") {
    Scene scene = floorScene(1e4f);
    addQuad(scene, {-1e-3f, 0, 0}, {0, 0, 1e4f}, {0, 1e4f, 0});
    scene.environment = glm::vec3(1.0f);
    CameraView camera = downCamera(2.0f, 0.2f);
    camera.position.x = camera.target.x = 0.5f;
    const Frame frame =
        rendered(scene, camera, {.extent = {4, 4}, .lightSamples = manySamples, .threads = 1});
    CHECK(irradiance(frame, 2, 2) == doctest::Approx(pi / 2).epsilon(sampled));
}

TEST_CASE("a closed box sees neither environment nor sun") {
    Scene scene;
    addMaterial(scene, glm::vec3(0.5f));
    for (const float side : {-1.0f, 1.0f})
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 centre(0.0f), a(0.0f), b(0.0f);
            centre[axis] = side;
            a[(axis + 1) % 3] = 1.0f;
            b[(axis + 2) % 3] = 1.0f;
            addQuad(scene, centre, a, b);
        }
    scene.environment = glm::vec3(10.0f);
    scene.lights = {lightOf(LightType::directional, glm::vec3(9.0f))};
    CameraView camera;
    camera.position = {0.3f, 0.2f, 0.9f};
    camera.target = {0, 0, -1};
    camera.verticalFieldOfView = 2.0f;
    const Frame frame = rendered(scene, camera, {.extent = {64, 64}, .lightSamples = 64, .threads = 1});
    for (const float value : frame.direct.data) REQUIRE(value == 0.0f); // edges included
}
