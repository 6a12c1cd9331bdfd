// SPDX-License-Identifier: MIT
#include "frame_test_scene.hpp"

#include <algorithm>
#include <numbers>

using namespace rebound;
using namespace rebound::lab;

namespace {

Light sun(glm::vec3 direction) {
    Light light;
    light.intensity = glm::vec3(std::numbers::pi_v<float>); // a floor that faces it has direct = 1
    light.direction = glm::normalize(direction);
    return light;
}

// A lattice with 8 x 8 texels on a quad 1 m above the floor: texels with x + y odd are holes.
Scene latticeScene(float factor, float cutoff) {
    Scene scene = floorScene();
    Texture lattice{"lattice", 8, 8, Wrap::clamp, Wrap::clamp, std::vector<uint8_t>(8 * 8 * 4, 255)};
    for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 8; ++x) lattice.rgba[(y * 8 + x) * 4 + 3] = (x + y) % 2 == 0 ? 255 : 0;
    scene.textures.push_back(lattice);
    Material mask;
    mask.baseColor = {1, 0, 0, factor};
    mask.baseColorTexture = 0;
    mask.alphaMasked = true;
    mask.alphaCutoff = cutoff;
    scene.materials.push_back(mask);
    addQuad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 1);
    return scene;
}

CameraView viewOfTexelCentres() {
    CameraView camera = downCamera();
    camera.orthographic = true;
    camera.orthographicHeight = 2.0f;
    return camera;
}

// Seeded, the same everywhere.
float uniform(uint32_t& state) {
    state = state * 1664525u + 1013904223u;
    return float(state >> 8) * 0x1p-24f;
}

} // namespace

TEST_CASE("shadows lie where the sun, a point light and a spot cannot see") {
    Scene scene = floorScene();
    addQuad(scene, {0, 1, 0}, {0, 0, 0.5f}, {0.5f, 0, 0});
    CameraView camera = downCamera(0.9f, 2.6f); // beneath the occluder
    const FrameOptions options{.extent = {81, 81}, .threads = 1};
    Light spot = sun({0, -1, 0});
    spot.type = LightType::spot;
    spot.position = {0, 2, 0};
    spot.outerCone = 1.4f;
    Light point = spot;
    point.type = LightType::point;
    // From 2 m, the quad at 1 m casts a shadow of twice its size; the sun's is displaced by the slope.
    struct Case {
        Light light;
        double centre;
        double halfSize;
    };
    for (const Case& expected :
         {Case{sun({1, -1, 0}), 1.0, 0.5}, Case{point, 0.0, 1.0}, Case{spot, 0.0, 1.0}}) {
        scene.lights = {expected.light};
        const Frame frame = rendered(scene, camera, options);
        int shadowed = 0;
        for (int y = 0; y < 81; ++y)
            for (int x = 0; x < 81; ++x) {
                const glm::dvec3 p = positionAt(frame, x, y);
                const bool dark =
                    std::abs(p.x - expected.centre) < expected.halfSize && std::abs(p.z) < expected.halfSize;
                shadowed += dark;
                CHECK((*frame.direct.at(x, y) == 0.0f) == dark);
            }
        CHECK(shadowed > 50);
    }
}

TEST_CASE("an area light's shadow is soft") {
    Scene scene = floorScene();
    addQuad(scene, {50, 1, 0}, {0, 0, 100}, {50, 0, 0}); // covers x > 0
    Light area;
    area.type = LightType::area;
    area.position = {0, 2, 0};
    area.right = {1, 0, 0};
    area.size = {1, 1};
    area.intensity = glm::vec3(1.0f);
    scene.lights = {area};
    CameraView camera = downCamera(0.9f, 0.11f); // 2 m from left to right
    const Frame frame = rendered(scene, camera, {.extent = {61, 3}, .lightSamples = 1024, .threads = 1});
    int partly = 0;
    for (int x = 0; x < 61; ++x) {
        // The edge at half height mirrors the light: of its x from -0.5 to 0.5 m, what lies below -p.x is
        // seen.
        const glm::dvec3 p = positionAt(frame, x, 1);
        const double seen = std::clamp(-p.x, -0.5, 0.5);
        partly += std::abs(seen) < 0.5;
        const std::array<glm::dvec3, 4> part{
            glm::dvec3(-0.5, 2, -0.5), {seen, 2, -0.5}, {seen, 2, 0.5}, {-0.5, 2, 0.5}};
        const double expected = seen > -0.5 ? lambert(part, p, {0, 1, 0}) : 0.0;
        // Of 32 x 32 strata, the shadow's edge cuts 32, and each is seen or not: 6 of 1024, in units of the
        // whole.
        CHECK(std::numbers::pi * double(*frame.direct.at(x, 1)) ==
              doctest::Approx(expected).epsilon(0.006).scale(0.25));
    }
    CHECK(partly > 20);
}

TEST_CASE("cut-outs are holes for the camera and for light") {
    const FrameOptions options{.extent = {8, 8}, .threads = 1}; // one pixel a texel, through its centre
    for (const float factor : {1.0f, 0.6f}) {
        Scene scene = latticeScene(factor, 0.6f); // an opacity that equals the cutoff lets nothing through
        scene.lights = {sun({0, -1, 0})};
        Frame frame = rendered(scene, viewOfTexelCentres(), options);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                const bool solid = (x + y) % 2 == 0;
                CHECK(*frame.depth.at(x, y) == doctest::Approx(solid ? 1.0 : 2.0));
                CHECK(*frame.direct.at(x, y) == doctest::Approx(1.0)); // the sun shines through the hole
            }
        CameraView beneath = viewOfTexelCentres();
        beneath.position.y = 0.9f;
        frame = rendered(scene, beneath, options);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x)
                CHECK(*frame.direct.at(x, y) == doctest::Approx((x + y) % 2 == 0 ? 0.0 : 1.0));
    }
    const Scene open = latticeScene(0.59f, 0.6f);
    CHECK(*rendered(open, viewOfTexelCentres(), options).depth.at(0, 0) == doctest::Approx(2.0));
}

TEST_CASE("unmasked materials have no holes") {
    Scene scene = latticeScene(0.1f, 0.5f);
    scene.materials[1].alphaMasked = false;
    const Frame frame = rendered(scene, viewOfTexelCentres(), {.extent = {8, 8}, .threads = 1});
    for (const float depth : frame.depth.data) CHECK(depth == doctest::Approx(1.0));
}

TEST_CASE("surfaces do not shadow themselves, whatever their size, place and tilt") {
    uint32_t state = 7;
    for (const float scale : {1e-4f, 1e-2f, 1.0f, 1e2f, 1e5f})
        for (const float away : {0.0f, 30.0f})
            for (int trial = 0; trial < 20; ++trial) {
                Scene scene;
                addMaterial(scene, glm::vec3(0.5f));
                const auto vector = [&] {
                    return glm::vec3(uniform(state), uniform(state), uniform(state)) * 2.0f - 1.0f;
                };
                const glm::vec3 a = glm::normalize(vector());
                const glm::vec3 b = glm::normalize(glm::cross(a, vector()));
                const glm::vec3 normal = glm::normalize(glm::cross(a, b));
                const glm::vec3 centre = vector() * away * scale;
                addQuad(scene, centre, a * scale, b * scale);
                scene.lights = {sun(-(normal + 0.99f * a))};
                scene.environment = glm::vec3(1.0f);
                CameraView camera;
                camera.position = centre + (normal * 2.0f + 0.1f * b) * scale;
                camera.target = centre;
                camera.up = a;
                camera.verticalFieldOfView = 0.7f;
                camera.nearPlane = 0.1f * scale;
                camera.farPlane = 10.0f * scale;
                const Frame frame =
                    rendered(scene, camera, {.extent = {24, 24}, .lightSamples = 4, .threads = 1});
                const double expected = 1.0 + double(glm::dot(normal, glm::normalize(normal + 0.99f * a)));
                const auto [least, most] =
                    std::minmax_element(frame.direct.data.begin(), frame.direct.data.end());
                // Only hemisphere rays within 1e-3 of the horizon may go astray where coordinates are rounded
                // to 1e-6 of the quad; 24 * 24 * 4 cosine-weighted rays hold none of them.
                CAPTURE(scale);
                CAPTURE(away);
                CHECK(*least == doctest::Approx(expected).epsilon(1e-3));
                CHECK(*most == doctest::Approx(expected).epsilon(1e-3));
            }
}

TEST_CASE("contact shadows begin a thousandth of the scene's size away, at every scale") {
    for (const float scale : {1e-4f, 1.0f, 1e5f}) {
        Scene scene = floorScene(scale);
        addQuad(scene, {0, 1e-3f * scale, 0}, {0, 0, 0.5f * scale}, {0.5f * scale, 0, 0});
        scene.lights = {sun({0, -1, 0.2f})};
        CameraView camera = downCamera(5e-4f * scale, 1.0f); // between the two
        camera.nearPlane = 1e-6f * scale;
        camera.farPlane = scale;
        const Frame frame = rendered(scene, camera, {.extent = {16, 16}, .threads = 1});
        for (const float value : frame.direct.data) CHECK(value == 0.0f);
        CHECK(*frame.depth.at(3, 3) > 0.0f);
    }
}
