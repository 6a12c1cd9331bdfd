// SPDX-License-Identifier: MIT
// Path-traced light against closed forms.
#include "path_tracer_test_light.hpp"

#include <array>
#include <numbers>

using namespace rebound;
using namespace rebound::lab;

namespace {

constexpr double pi = std::numbers::pi;

Scene boxScene(float albedo, float emission = 0.0f) {
    Scene scene;
    scene.name = "box";
    addMaterial(scene, glm::vec3(albedo), glm::vec3(emission));
    addBox(scene);
    return scene;
}

CameraView wallCamera() { return patchCamera({0, 0, -1}, {0, 0, -1}, 1.0f, 2.0f); }

double geometricSum(double ratio, int first, int last) {
    double sum = 0.0;
    for (int k = first; k <= last; ++k) sum += std::pow(ratio, k);
    return sum;
}

// Two parallel unit squares one apart, one above the other (Siegel and Howell, configuration 38).
double parallelSquaresFormFactor() {
    const double root = std::sqrt(2.0);
    return 2.0 / pi *
           (std::log(std::sqrt(4.0 / 3.0)) + 2.0 * root * std::atan(1.0 / root) - 2.0 * std::atan(1.0));
}

} // namespace

TEST_CASE("a furnace: a closed box that emits from everywhere") {
    for (const float albedo : {0.0f, 0.3f, 0.7f, 0.95f})
        for (const int bounces : {0, 1, 2, 8}) {
            CAPTURE(albedo);
            CAPTURE(bounces);
            const auto light = traced(boxScene(albedo, 2.5f), wallCamera(),
                                      {.extent = {8, 8}, .bounces = bounces, .samples = 256});
            CHECK(meanOf(light.direct) == doctest::Approx(2.5).epsilon(0.01));
            const double truth = 2.5 * geometricSum(double(albedo), 1, bounces);
            CHECK(std::abs(meanOf(light.indirect) - truth) <= allowedDifference(light, truth));
            const double first = bounces > 0 ? 2.5 * double(albedo) : 0.0;
            CHECK(std::abs(meanOf(light.firstBounce) - first) <= allowedDifference(light, first));
        }
}

TEST_CASE("emission that is no direct light counts as light of a surface that was met") {
    for (const int bounces : {0, 1, 3}) {
        CAPTURE(bounces);
        Scene scene = boxScene(0.4f, 2.5f);
        scene.emissiveMaterialsLight = false;
        const auto light =
            traced(scene, wallCamera(), {.extent = {8, 8}, .bounces = bounces, .samples = 256});
        for (const float value : light.direct.data) REQUIRE(value == 0.0f);
        // The furnace's sum, a surface later: nothing is direct, and the emitter is the first that was met.
        const double truth = bounces > 0 ? 2.5 * geometricSum(0.4, 0, bounces - 1) : 0.0;
        CHECK(std::abs(meanOf(light.indirect) - truth) <= allowedDifference(light, truth));
        CHECK(std::abs(meanOf(light.firstBounce) - (bounces > 0 ? 2.5 : 0.0)) <=
              allowedDifference(light, 2.5));
    }
}

TEST_CASE("energy: what a point in the middle of a cube sends out meets its walls again and again") {
    for (const float albedo : {0.2f, 0.8f})
        for (const int bounces : {1, 3, 64}) {
            CAPTURE(albedo);
            CAPTURE(bounces);
            Scene scene = boxScene(albedo);
            Light point;
            point.type = LightType::point;
            point.intensity = glm::vec3(3.0f);
            scene.lights = {point};
            const auto light =
                traced(scene, wallCamera(), {.extent = {16, 16}, .bounces = bounces, .samples = 512});
            // The flux of 4 pi I falls on 6 walls of 4 m^2; symmetry shares every bounce's among them.
            const double direct = 4.0 * pi * 3.0 / 24.0 / pi;
            const double truth = direct * geometricSum(double(albedo), 1, bounces);
            CHECK(std::abs(meanOf(light.indirect) - truth) <= allowedDifference(light, truth));
            // The midpoint rule on 16 x 16 places: cos^4 is smooth.
            CHECK(meanOf(light.direct) == doctest::Approx(direct).epsilon(1e-3));
        }
}

TEST_CASE("a constant environment over a plane") {
    Scene scene = floorScene(5.0f, glm::vec3(0.9f));
    scene.environment = {0.7f, 0.2f, 0.1f};
    const auto light = traced(scene, downCamera(), {.extent = {4, 4}, .bounces = 4, .samples = 8});
    for (int x = 0; x < 4; ++x) {
        // Every direction brings the same: there is no noise, only rounding of a few sums.
        CHECK(light.direct.at(x, 1)[0] == doctest::Approx(0.7).epsilon(1e-5));
        CHECK(light.direct.at(x, 1)[2] == doctest::Approx(0.1).epsilon(1e-5));
        CHECK(light.indirect.at(x, 1)[0] == 0.0f);
        CHECK(light.standardError.data[size_t(x)] == 0.0f);
    }
}

TEST_CASE("one bounce from a square: form factors of a point and of a parallel square") {
    Scene scene;
    addMaterial(scene, glm::vec3(0.6f));
    addQuad(scene, {0, 0, 0}, {0, 0, 0.5f}, {0.5f, 0, 0});
    addQuad(scene, {0, 1, 0}, {0.5f, 0, 0}, {0, 0, 0.5f});
    Light sun; // low enough that the upper square's shadow falls beside the lower one
    sun.direction = {std::sin(1.1f), -std::cos(1.1f), 0};
    sun.intensity = glm::vec3(4.0f);
    scene.lights = {sun};
    const CameraView camera = patchCamera({0, 1, 0}, {0, 1, 0}, 0.5f, 1.0f);
    const auto light = traced(scene, camera, {.extent = {16, 16}, .bounces = 1, .samples = 1024});
    const double sent = 0.6 * 4.0 * std::cos(1.1) / pi;
    const double truth = sent * parallelSquaresFormFactor();
    // The midpoint rule on 16 x 16 places is exact to 1e-3 here.
    CHECK(std::abs(meanOf(light.indirect) - truth) <= allowedDifference(light, truth) + 1e-3 * truth);
    const std::array<glm::dvec3, 4> corners{{{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5}, {-0.5, 0, 0.5}}};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const glm::dvec3 at((x + 0.5) / 16 - 0.5, 1.0, (y + 0.5) / 16 - 0.5);
            const double pointTruth = sent * lambert(corners, at, {0, -1, 0}) / pi;
            // Five standard errors: 256 pixels are looked at, with eight values each to tell the error by.
            const double allowed = std::max(10.0 * double(*light.standardError.at(x, y)), 0.01 * pointTruth);
            CHECK(std::abs(double(*light.indirect.at(x, y)) - pointTruth) <= allowed);
        }
    CHECK(meanOf(light.direct) == 0.0);
}

TEST_CASE("one bounce from a disc: the form factor of a point over its centre") {
    constexpr int sides = 720;
    constexpr double radius = 0.75, height = 0.5;
    Scene scene;
    addMaterial(scene, glm::vec3(0.5f));
    Mesh disc;
    disc.positions = {glm::vec3(0.0f)};
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * pi * i / sides;
        disc.positions.emplace_back(float(radius * std::sin(angle)), 0.0f, float(radius * std::cos(angle)));
        for (const int corner : {0, 1 + i, 1 + (i + 1) % sides}) disc.indices.push_back(uint32_t(corner));
    }
    disc.normals.assign(disc.positions.size(), glm::vec3(0, 1, 0));
    scene.meshes = {disc};
    addQuad(scene, {0, float(height), 0}, {0.001f, 0, 0}, {0, 0, 0.001f});
    Light sun;
    sun.direction = {std::sin(1.0f), -std::cos(1.0f), 0};
    sun.intensity = glm::vec3(2.0f);
    scene.lights = {sun};
    const CameraView camera = patchCamera({0, float(height), 0}, {0, 1, 0}, 0.1f, 0.001f);
    const auto light = traced(scene, camera, {.extent = {4, 4}, .bounces = 1, .samples = 4096});
    const double sent = 0.5 * 2.0 * std::cos(1.0) / pi;
    const double truth = sent * radius * radius / (radius * radius + height * height);
    // The small square's shadow hides 4e-6 of the disc; 720 sides leave out 1e-5 of a circle.
    CHECK(std::abs(meanOf(light.indirect) - truth) <= allowedDifference(light, truth) + 2e-5 * truth);
}

TEST_CASE("reciprocity: two patches in a box with an obstacle light each other alike") {
    const auto exchanged = [](bool firstEmits) {
        Scene scene = boxScene(0.6f);
        const int first = addMaterial(scene, glm::vec3(0.3f), glm::vec3(firstEmits ? 5.0f : 0.0f));
        const int second = addMaterial(scene, glm::vec3(0.3f), glm::vec3(firstEmits ? 0.0f : 5.0f));
        addQuad(scene, {-0.2f, -0.99f, 0.3f}, {0, 0, 0.2f}, {0.2f, 0, 0}, first);
        addQuad(scene, {0.99f, 0.4f, -0.1f}, {0, 0, 0.3f}, {0, 0.3f, 0}, second);
        addQuad(scene, {0.3f, -0.3f, 0.2f}, {0.25f, 0.2f, 0}, {0, 0, 0.25f});
        const CameraView camera = firstEmits ? patchCamera({0.99f, 0.4f, -0.1f}, {1, 0, 0}, 0.1f, 0.6f)
                                             : patchCamera({-0.2f, -0.99f, 0.3f}, {0, -1, 0}, 0.1f, 0.4f);
        const auto light = traced(scene, camera, {.extent = {24, 24}, .bounces = 6, .samples = 512});
        const double area = firstEmits ? 0.36 : 0.16;
        return std::pair{area * (meanOf(light.direct) + meanOf(light.indirect)),
                         area * standardErrorOfMean(light)};
    };
    const auto [forward, forwardError] = exchanged(true);
    const auto [backward, backwardError] = exchanged(false);
    // Direct light's own error is not in the standard error: it is about as large, so that 6 stand for 4.5.
    // Shadow edges on 24 x 24 places leave 0.3 %.
    CHECK(std::abs(forward - backward) <= 6.0 * std::hypot(forwardError, backwardError) + 3e-3 * forward);
}

TEST_CASE("an area light's indirect light does not depend on whether it is a light or a surface") {
    Scene withLight = boxScene(0.5f);
    Light area;
    area.type = LightType::area;
    area.position = {0.2f, 0.98f, -0.1f};
    area.direction = {0, -1, 0};
    area.size = {0.5f, 0.4f};
    area.intensity = glm::vec3(6.0f);
    Scene withSurface = withLight;
    withLight.lights = {area};
    // A black surface that emits; its upper side, one centimetre below the ceiling, lights next to nothing.
    const int emitter = addMaterial(withSurface, glm::vec3(0.0f), glm::vec3(6.0f));
    addQuad(withSurface, {0.2f, 0.999f, -0.1f}, {0.25f, 0, 0}, {0, 0, 0.2f}, emitter);
    const PathTracerOptions options{.extent = {12, 12}, .bounces = 3, .samples = 1024};
    const CameraView camera = patchCamera({0, -1, 0}, {0, -1, 0}, 1.0f, 2.0f);
    withLight.lights[0].position.y = 0.999f;
    const auto light = traced(withLight, camera, options);
    const auto surface = traced(withSurface, camera, options);
    const double error = std::hypot(standardErrorOfMean(light), standardErrorOfMean(surface));
    CHECK(meanOf(light.direct) == doctest::Approx(meanOf(surface.direct)).epsilon(0.005));
    // The black surface hides 0.2 m^2 of a ceiling of 4 m^2, which a light does not, and lights the rest of
    // it along a gap of 1 mm: 2 % of the light.
    CHECK(std::abs(meanOf(light.indirect) - meanOf(surface.indirect)) <=
          4.5 * error + 0.02 * meanOf(light.indirect));
}
