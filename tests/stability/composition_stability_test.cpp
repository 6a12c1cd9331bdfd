// SPDX-License-Identifier: MIT
// Illuminance composition where such methods fail: a spot that crosses surfels, a sun whose shadow crosses patches, lights
// that switch, walls that light must not pass. Each remedy is switched off once, and has to be missed.
#include "baked_scene.hpp"

#include "lab/scenes/scene_builder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace rebound::stability {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float floorAlbedo = 0.5f;

lab::CameraView orthographic(glm::vec3 position, glm::vec3 target, glm::vec3 up, float height) {
    lab::CameraView camera;
    camera.position = position;
    camera.target = target;
    camera.up = up;
    camera.orthographic = true;
    camera.orthographicHeight = height;
    camera.nearPlane = 0.1f;
    camera.farPlane = 20.0f;
    return camera;
}

// A floor of 6 x 6 m, and at its back a black wall of 3 m that is watched. A roof over half of it if wanted, black too.
lab::Scene floorAndWall(bool hasRoof) {
    lab::SceneBuilder builder("floor and wall");
    builder.surface("floor", glm::vec3(floorAlbedo)).box({-3, -0.2f, -3}, {3, 0, 3});
    builder.surface("wall", glm::vec3(0.0f)).box({-3, 0, -3.2f}, {3, 3, -3});
    if (hasRoof) builder.surface("roof", glm::vec3(0.0f)).box({-3, 3, -3}, {0, 3.1f, 3});
    lab::Scene scene = builder.take();
    scene.cameras = {orthographic({0, 1.5f, 1}, {0, 1.5f, -3}, {0, 1, 0}, 3.0f)};
    return scene;
}

// What the wall receives from the floor, in one bounce: a sum over the floor's direct light, which nothing hides.
std::vector<double> wallTruth(lab::Scene scene, const std::vector<lab::Light>& lights, Extent2D extent) {
    scene.lights = lights;
    constexpr int side = 240;
    // From below the roof.
    const lab::CameraView above = orthographic({0, 2.9f, 0}, {0, 0, 0}, {0, 0, -1}, 6.0f);
    const lab::Frame seen = take(lab::renderFrame(scene, above, {.extent = {side, side}}));
    std::vector<double> light;
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const glm::dvec3 place(6.0 * (x + 0.5) / extent.width - 3.0,
                                   3.0 - 3.0 * (y + 0.5) / extent.height, -3);
            double sum = 0.0;
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i) {
                    const auto direct = double(*seen.direct.at(i, j)); // of grey light
                    if (direct == 0.0) continue;
                    const glm::dvec3 from(6.0 * (i + 0.5) / side - 3.0, 0.0, 6.0 * (j + 0.5) / side - 3.0);
                    const glm::dvec3 way = from - place;
                    const double square = glm::dot(way, way);
                    sum += direct * way.z * place.y / (square * square);
                }
            light.push_back(sum * double(floorAlbedo) / pi * 36.0 / (side * side));
        }
    return light;
}

std::vector<double> grey(const lab::Image& image) {
    std::vector<double> values(image.data.size() / 3);
    for (size_t i = 0; i < values.size(); ++i) values[i] = double(image.data[3 * i]);
    return values;
}

BakedSceneOptions smallBake() {
    BakedSceneOptions options;
    options.bake.surfels = 2500;
    options.bake.caches = 1500;
    options.bounces = false;
    return options;
}

lab::Light spotAbove(float x) {
    lab::Light spot;
    spot.type = lab::LightType::spot;
    spot.position = {x, 2.5f, 0.4f};
    spot.intensity = glm::vec3(10.0f);
    spot.outerCone = 0.1f; // 0.25 m at the floor, where surfels are 0.15 m apart
    spot.innerCone = 0.08f;
    return spot;
}

// Changes from frame to frame that are not the truth's, over the mean light; root mean square over pixels and frames.
class Flicker {
public:
    void add(std::vector<double> result, std::vector<double> truth) {
        for (size_t i = 0; i < result.size(); ++i) {
            light += truth[i];
            ++count;
            if (was.empty()) continue;
            const double off = (result[i] - was[i]) - (truth[i] - trulyWas[i]);
            squares += off * off;
        }
        was = std::move(result);
        trulyWas = std::move(truth);
    }
    double value() const { return std::sqrt(squares / double(count)) / (light / double(count)); }

private:
    std::vector<double> was, trulyWas;
    double squares = 0.0, light = 0.0;
    size_t count = 0;
};

double spotFlicker(int placesOfSurfel) {
    BakedSceneOptions options = smallBake();
    options.placesOfSurfel = placesOfSurfel;
    BakedScene scene(floorAndWall(false), options);
    Flicker flicker;
    for (int i = 0; i < 24; ++i) {
        const std::vector<lab::Light> lights{spotAbove(-0.6f + 0.05f * float(i))};
        flicker.add(grey(scene.light(lights)), wallTruth(scene.description(), lights, options.extent));
    }
    return flicker.value();
}

lab::Light sun(float degrees) {
    lab::Light light;
    light.direction = {std::sin(glm::radians(degrees)), -std::cos(glm::radians(degrees)), 0};
    light.intensity = glm::vec3(3.0f);
    return light;
}

// Largest second differences along the wall's rows, over the mean light.
double roughness(const std::vector<double>& light, Extent2D extent) {
    double largest = 0.0, mean = 0.0;
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const double* at = &light[size_t(y) * size_t(extent.width) + size_t(x)];
            mean += *at / double(light.size());
            if (x > 0 && x + 1 < extent.width)
                largest = std::max(largest, std::abs(at[-1] - 2.0 * at[0] + at[1]));
        }
    return largest / mean;
}

struct SunSweep {
    double flicker = 0.0, roughness = 0.0, trueRoughness = 0.0;
};

// A roof's shadow moves over the floor by some 5 cm a frame.
SunSweep sweepSun(uint32_t links) {
    BakedSceneOptions options = smallBake();
    options.bake.links = links;
    BakedScene scene(floorAndWall(true), options);
    SunSweep sweep;
    Flicker flicker;
    for (int i = 0; i < 16; ++i) {
        const std::vector<lab::Light> lights{sun(10.0f + float(i))};
        const std::vector<double> light = grey(scene.light(lights));
        const std::vector<double> truth = wallTruth(scene.description(), lights, options.extent);
        sweep.roughness = std::max(sweep.roughness, roughness(light, options.extent));
        sweep.trueRoughness = std::max(sweep.trueRoughness, roughness(truth, options.extent));
        flicker.add(light, truth);
    }
    sweep.flicker = flicker.value();
    return sweep;
}

lab::Scene room(float albedo, float length, const std::vector<std::array<glm::vec3, 2>>& boxes) {
    lab::SceneBuilder builder("room");
    lab::MeshBuilder& walls = builder.surface("walls", glm::vec3(albedo));
    const float t = 0.2f;
    walls.box({-t, -t, -t}, {length + t, 0, 3 + t});
    walls.box({-t, 3, -t}, {length + t, 3 + t, 3 + t});
    walls.box({-t, 0, -t}, {0, 3, 3 + t});
    walls.box({length, 0, -t}, {length + t, 3, 3 + t});
    walls.box({0, 0, -t}, {length, 3, 0});
    walls.box({0, 0, 3}, {length, 3, 3 + t});
    for (const auto& [low, high] : boxes) walls.box(low, high);
    lab::Scene scene = builder.take();
    scene.cameras = {lab::CameraView{}};
    return scene;
}

lab::CameraView inRoom(float firstX) {
    lab::CameraView camera;
    camera.position = {firstX + 0.3f, 1.5f, 0.3f};
    camera.target = {firstX + 3.0f, 1.4f, 2.4f};
    camera.verticalFieldOfView = 1.4f;
    return camera;
}

lab::Light lampAt(glm::vec3 position) {
    lab::Light lamp;
    lamp.type = lab::LightType::point;
    lamp.position = position;
    return lamp;
}

double meanOf(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / double(values.size());
}

// Two rooms of 3 x 3 x 3 m and a wall between, a lamp in one: what the other has of its light.
class TwoRooms {
public:
    TwoRooms(float wall, BakeHierarchy hierarchy)
        : second(3 + wall),
          scene(room(0.7f, 6 + wall, {{{{3, 0, 0}, {3 + wall, 3, 3}}}}), optionsOf(hierarchy)) {}

    double leak() {
        const double dark = lightIn(0.0f), lit = lightIn(second);
        return dark / lit;
    }

    // Receivers tell which caches of a cell a place sees.
    void forgetReceivers() {
        scene.alter([](Sections& sections) {
            std::vector<uint32_t>& cells = sections[size_t(BakeSection::cells)];
            for (size_t cell = 0; cell < cells.size(); cell += 12) cells[cell + 10] = 0;
        });
    }

private:
    static BakedSceneOptions optionsOf(BakeHierarchy hierarchy) {
        BakedSceneOptions options;
        options.extent = {64, 48};
        options.bake.surfels = 16384;
        options.bake.caches = 4000;
        options.bake.hierarchy = hierarchy;
        return options;
    }

    double lightIn(float firstX) {
        scene.watch(inRoom(firstX));
        lab::Image light;
        for (int frame = 0; frame < 8; ++frame) light = scene.light({lampAt({second + 1.5f, 2.0f, 1.5f})});
        return meanOf(grey(light));
    }

    float second; // room's lowest x
    BakedScene scene;
};

// Frames until the mean light is within a tenth of where it ends, after a lamp is switched on, and off again.
std::array<int, 2> framesToSwitch(float albedo) {
    BakedSceneOptions options;
    options.extent = {32, 24};
    options.bake.surfels = 1500;
    options.bake.caches = 500;
    BakedScene scene(room(albedo, 3, {}), options);
    scene.watch(inRoom(0));
    const auto run = [&](const std::vector<lab::Light>& lights) {
        std::vector<double> means;
        for (int i = 0; i < 40; ++i) means.push_back(meanOf(grey(scene.light(lights))));
        return means;
    };
    const std::vector<double> on = run({lampAt(glm::vec3(1.5f))}), off = run({});
    const double lit = on.back();
    const auto settled = [&](const std::vector<double>& means) {
        const auto close = [&](double mean) { return std::abs(mean - means.back()) <= 0.1 * lit; };
        return int(std::find_if(means.begin(), means.end(), close) - means.begin()) + 1;
    };
    return {settled(on), settled(off)};
}

} // namespace

TEST_CASE("a small spot that crosses surfels") {
    const double averaged = spotFlicker(16), single = spotFlicker(1);
    std::printf("spot over surfels: flicker %.3f of the light; lit at one place of each surfel %.3f\n",
                averaged, single);
    // A spot as wide as three surfels: what their discs cover twice or not at all is some of it.
    CHECK(averaged < 0.22);
    CHECK(single > 1.5 * averaged);
}

TEST_CASE("a shadow that moves over patches leaves no steps") {
    const SunSweep ours = sweepSun(128), few = sweepSun(4);
    std::printf(
        "moving sun: flicker %.4f, largest second difference %.3f (truth %.3f); with 4 links %.4f, %.3f\n",
        ours.flicker, ours.roughness, ours.trueRoughness, few.flicker, few.roughness);
    CHECK(ours.flicker < 0.04);
    CHECK(ours.roughness < ours.trueRoughness);
    CHECK(few.flicker > 1.25 * ours.flicker);
}

TEST_CASE("light does not pass a wall") {
    TwoRooms rooms(0.2f, BakeHierarchy::cluster);
    const double leak = rooms.leak();
    rooms.forgetReceivers();
    const double withoutReceivers = rooms.leak(), paper = TwoRooms(0.2f, BakeHierarchy::paper).leak();
    std::printf("wall of 0.2 m: %.5f of the light; without receivers %.5f; with the paper's clusters %.5f\n",
                leak, withoutReceivers, paper);
    CHECK(leak < 1e-3);
    CHECK(withoutReceivers > 2.0 * leak);
    CHECK(paper > 2.0 * leak);
}

TEST_CASE("a lamp that switches is answered as fast as bounces allow") {
    for (const float albedo : {0.5f, 0.8f}) {
        const auto [on, off] = framesToSwitch(albedo);
        std::printf("albedo %.1f: %d frames on, %d off\n", double(albedo), on, off);
        // Of bounces that each keep the albedo's share, n have all but albedo^n.
        const double expected = std::log(0.1) / std::log(double(albedo));
        CHECK(on >= expected);
        CHECK(on <= expected + 2.0);
        CHECK(off == on);
    }
}

} // namespace rebound::stability
