// SPDX-License-Identifier: MIT
// A vaulted brick tunnel under a street: a walkway of grating with railings and pipes close to the eye, the far end 40 m
// away; sun and sky fall in through gratings in the vault, lamps light the rest. A scene to judge by: no setting is chosen by
// what it shows.
#include "lab/scenes/scene_files.hpp"

#include "lab/scenes/builtin_textures.hpp"
#include "lab/scenes/scene_builder.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace rebound::lab {
namespace {

// The tunnel runs along -z; its vault springs at a height above the walkway's floor [m].
constexpr float halfWidth = 2.4f, spring = 1.7f, bottom = -1.3f, nearEnd = 4.0f, farEnd = -40.0f,
                shell = 0.4f;
constexpr int arcSteps = 16;
constexpr std::array<float, 3> shafts = {-6.0f, -18.0f, -31.0f};
constexpr float shaftHalf = 0.8f, street = 6.0f;
// The walkway lies along the right wall.
constexpr float walkInner = 0.75f, walkOuter = 2.25f;

struct Tunnel : SceneBuilder {
    Tunnel() : SceneBuilder("tunnel") {}

    MeshBuilder& bricks =
        surface("bricks", glm::vec3(1.0f),
                texture(makeMasonryTexture("bricks", {{0.46f, 0.24f, 0.16f}, {0.26f, 0.13f, 0.09f}},
                                           {0.36f, 0.33f, 0.29f})),
                1.1f);
    MeshBuilder& concrete =
        surface("concrete", glm::vec3(1.0f),
                texture(makeStoneTexture("concrete", {{0.5f, 0.49f, 0.46f}, {0.3f, 0.295f, 0.28f}})), 0.5f);
    MeshBuilder& steel = surface("steel", {0.3f, 0.31f, 0.32f});
    MeshBuilder& yellow = surface("yellow rails", {0.72f, 0.48f, 0.05f});
    MeshBuilder& rust =
        surface("rusty pipes", glm::vec3(1.0f),
                texture(makeStoneTexture("rust", {{0.42f, 0.2f, 0.1f}, {0.2f, 0.12f, 0.09f}})), 1.5f);
    MeshBuilder& blue = surface("blue pipes", {0.08f, 0.22f, 0.4f});
    MeshBuilder& green = surface("green pipes", {0.12f, 0.32f, 0.2f});
    MeshBuilder& red = surface("valves", {0.6f, 0.05f, 0.04f});
    MeshBuilder& cable = surface("cables", {0.04f, 0.04f, 0.045f});
    MeshBuilder& water = surface("still water", {0.05f, 0.075f, 0.06f});
    MeshBuilder& pavement = surface("pavement", {0.4f, 0.39f, 0.37f});
};

// The vault's cross-section at an angle from 0 (right) to pi (left).
glm::vec2 arc(float radius, float angle) {
    return {radius * std::cos(angle), spring + radius * std::sin(angle)};
}

// A part of a vault of that radius between two angles and two places along the tunnel, as a closed shell.
void addVault(MeshBuilder& mesh, float radius, float thickness, float from, float to, float back,
              float frontZ) {
    const int steps =
        std::max(1, static_cast<int>(std::lround((to - from) / std::numbers::pi_v<float> * arcSteps)));
    for (int i = 0; i < steps; ++i) {
        const float a = from + (to - from) * static_cast<float>(i) / static_cast<float>(steps);
        const float b = from + (to - from) * static_cast<float>(i + 1) / static_cast<float>(steps);
        const glm::vec2 innerA = arc(radius, a), innerB = arc(radius, b);
        const glm::vec2 outerA = arc(radius + thickness, a), outerB = arc(radius + thickness, b);
        const auto at = [&](const glm::vec2& p, float z) { return glm::vec3(p.x, p.y, z); };
        const auto quad = [&](const glm::vec3& p, const glm::vec3& q, const glm::vec3& r,
                              const glm::vec3& t) {
            mesh.face(std::array<glm::vec3, 4>{p, q, r, t});
        };
        quad(at(innerA, frontZ), at(innerB, frontZ), at(innerB, back), at(innerA, back));
        quad(at(outerA, back), at(outerB, back), at(outerB, frontZ), at(outerA, frontZ));
        quad(at(outerA, frontZ), at(outerB, frontZ), at(innerB, frontZ), at(innerA, frontZ));
        quad(at(innerA, back), at(innerB, back), at(outerB, back), at(outerA, back));
        quad(at(innerA, back), at(outerA, back), at(outerA, frontZ), at(innerA, frontZ));
        quad(at(outerB, back), at(innerB, back), at(innerB, frontZ), at(outerB, frontZ));
    }
}

void addShell(Tunnel& t) {
    const float w = halfWidth, pi = std::numbers::pi_v<float>;
    t.concrete.box({-w - shell, bottom - shell, farEnd}, {w + shell, bottom, nearEnd});
    for (const float side : {-1.0f, 1.0f}) {
        const float a = side * w, b = side * (w + shell);
        t.bricks.box({std::min(a, b), bottom, farEnd}, {std::max(a, b), spring, nearEnd});
        t.concrete.box({side > 0 ? w - 0.09f : -w, spring - 0.16f, farEnd},
                       {side > 0 ? w : -w + 0.09f, spring, nearEnd});
    }
    // The vault is open at its top under each shaft.
    const float opening = std::asin(shaftHalf / halfWidth), low = pi / 2 - opening, high = pi / 2 + opening;
    addVault(t.bricks, halfWidth, shell, 0.0f, low, farEnd, nearEnd);
    addVault(t.bricks, halfWidth, shell, high, pi, farEnd, nearEnd);
    float from = nearEnd;
    for (const float shaft : shafts) {
        addVault(t.bricks, halfWidth, shell, low, high, shaft + shaftHalf, from);
        from = shaft - shaftHalf;
    }
    addVault(t.bricks, halfWidth, shell, low, high, farEnd, from);
    for (const auto& [a, b] : {std::pair{farEnd - shell, farEnd}, std::pair{nearEnd, nearEnd + shell}})
        t.bricks.box({-w - shell, bottom - shell, a}, {w + shell, spring + w + shell, b});
    // A ledge on the left, and the water between.
    t.concrete.box({-w, bottom, farEnd}, {-w + 0.9f, -0.35f, nearEnd});
    t.water.box({-w + 0.9f, bottom, farEnd}, {w, bottom + 0.25f, nearEnd});
    for (int i = 0; i < 6; ++i) {
        const float z = 1.0f - 8.0f * static_cast<float>(i);
        addVault(t.concrete, halfWidth - 0.14f, 0.14f, 0.0f, low - 0.02f, z - 0.25f, z + 0.25f);
        addVault(t.concrete, halfWidth - 0.14f, 0.14f, high + 0.02f, pi, z - 0.25f, z + 0.25f);
        for (const float side : {-1.0f, 1.0f}) {
            const float a = side * (w - 0.14f), b = side * w;
            t.concrete.box({std::min(a, b), side > 0 ? bottom : -0.35f, z - 0.25f},
                           {std::max(a, b), spring, z + 0.25f});
        }
    }
}

// Shafts up to the street, closed by gratings.
void addShafts(Tunnel& t) {
    const float base = spring + halfWidth - 0.3f, h = shaftHalf;
    for (const float z : shafts) {
        t.concrete.box({-h - 0.25f, base, z - h - 0.25f}, {-h, street, z + h + 0.25f});
        t.concrete.box({h, base, z - h - 0.25f}, {h + 0.25f, street, z + h + 0.25f});
        t.concrete.box({-h, base, z - h - 0.25f}, {h, street, z - h});
        t.concrete.box({-h, base, z + h}, {h, street, z + h + 0.25f});
        for (int i = 0; i < 9; ++i) {
            const float x = -h + 2.0f * h * (static_cast<float>(i) + 0.5f) / 9.0f;
            t.steel.box({x - 0.012f, street - 0.1f, z - h}, {x + 0.012f, street - 0.02f, z + h});
        }
        for (const float at : {-0.4f, 0.0f, 0.4f})
            t.steel.box({-h, street - 0.09f, z + at - 0.01f}, {h, street - 0.03f, z + at + 0.01f});
        // Rungs up the shaft's wall.
        for (int i = 0; i < 8; ++i)
            t.steel.rod({h - 0.1f, base + 0.3f * static_cast<float>(i), z - 0.2f},
                        {h - 0.1f, base + 0.3f * static_cast<float>(i), z + 0.2f}, 0.012f, 8);
    }
}

// Bearing bars along the walkway and rods across, on beams that the wall carries.
void addWalkway(Tunnel& t) {
    constexpr float begin = 3.5f, end = -36.0f, thick = 0.035f;
    for (int i = 0; i <= 30; ++i) {
        const float x = walkInner + (walkOuter - walkInner) * static_cast<float>(i) / 30.0f;
        t.steel.box({x - 0.0025f, -thick, end}, {x + 0.0025f, 0.0f, begin});
    }
    for (int i = 0; i < 395; ++i) {
        const float z = begin - 0.05f - 0.1f * static_cast<float>(i);
        t.steel.box({walkInner, -0.014f, z - 0.003f}, {walkOuter, -0.003f, z + 0.003f});
    }
    for (const float x : {walkInner - 0.03f, walkOuter})
        t.steel.box({x, -0.12f, end}, {x + 0.03f, 0.012f, begin});
    for (int i = 0; i <= 19; ++i) {
        const float z = begin - 0.4f - 2.0f * static_cast<float>(i);
        t.steel.box({walkInner, -0.14f, z - 0.03f}, {halfWidth, -0.04f, z + 0.03f});
    }
}

void addRailing(Tunnel& t) {
    constexpr float x = walkInner + 0.03f, begin = 3.4f, end = -36.0f;
    for (const float y : {0.35f, 0.68f}) t.yellow.rod({x, y, begin}, {x, y, end}, 0.014f, 10);
    t.yellow.rod({x, 1.02f, begin}, {x, 1.02f, end}, 0.021f, 14);
    t.yellow.box({x - 0.004f, 0.0f, end}, {x + 0.004f, 0.1f, begin});
    for (int i = 0; i <= 26; ++i) {
        const float z = begin - 1.5f * static_cast<float>(i);
        t.yellow.rod({x, -0.1f, z}, {x, 1.02f, z}, 0.017f, 10);
    }
}

void addPipe(MeshBuilder& mesh, float x, float y, float radius) {
    mesh.rod({x, y, nearEnd}, {x, y, farEnd}, radius, 24);
    for (int i = 0; i < 11; ++i) {
        const float z = 2.0f - 4.0f * static_cast<float>(i);
        mesh.rod({x, y, z - 0.03f}, {x, y, z + 0.03f}, radius * 1.28f, 24);
        mesh.rod({x, y, z - 0.05f}, {x, y, z - 0.035f}, radius * 1.2f, 24);
    }
}

// On the left wall, on brackets; cables sag along the right one.
void addPipes(Tunnel& t) {
    const float wall = -halfWidth;
    addPipe(t.rust, wall + 0.36f, 0.55f, 0.22f);
    addPipe(t.blue, wall + 0.24f, 1.02f, 0.1f);
    addPipe(t.green, wall + 0.2f, 1.32f, 0.07f);
    for (int i = 0; i < 14; ++i) {
        const float z = 3.0f - 3.0f * static_cast<float>(i);
        t.steel.box({wall, 0.26f, z - 0.02f}, {wall + 0.6f, 0.32f, z + 0.02f});
        t.steel.box({wall, 0.87f, z - 0.02f}, {wall + 0.36f, 0.91f, z + 0.02f});
        t.steel.box({wall, 1.22f, z - 0.02f}, {wall + 0.3f, 1.25f, z + 0.02f});
    }
    for (int line = 0; line < 3; ++line)
        for (int i = 0; i < 120; ++i) {
            const auto at = [&](int k) {
                const float s = static_cast<float>(k) / 12.0f, part = s - std::floor(s);
                return glm::vec3(halfWidth - 0.05f,
                                 1.45f - 0.09f * static_cast<float>(line) -
                                     (0.12f + 0.05f * static_cast<float>(line)) * 4.0f * part * (1.0f - part),
                                 nearEnd - 4.0f * s);
            };
            t.cable.rod(at(i), at(i + 1), 0.011f, 6);
        }
}

// What a path may turn: a hand wheel on the blue pipe.
void addValve(Tunnel& t) {
    const glm::vec3 hub(-halfWidth + 0.62f, 1.02f, -2.6f);
    t.steel.rod({-halfWidth + 0.24f, hub.y, hub.z}, hub, 0.016f, 10);
    MeshBuilder& wheel = t.object("valve", "valves");
    constexpr int parts = 24;
    const auto at = [&](int i) {
        const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i % parts) / parts;
        return hub + 0.16f * glm::vec3(0.0f, std::sin(angle), std::cos(angle));
    };
    for (int i = 0; i < parts; ++i) wheel.rod(at(i), at(i + 1), 0.013f, 8);
    for (int i = 0; i < parts; i += 6) wheel.rod(hub, at(i), 0.01f, 8);
    wheel.rod(hub - glm::vec3(0.02f, 0, 0), hub + glm::vec3(0.03f, 0, 0), 0.03f, 14);
}

Light areaLight(const std::string& name, const glm::vec3& position, const glm::vec3& direction,
                const glm::vec2& size, const glm::vec3& radiance) {
    Light light;
    light.name = name;
    light.type = LightType::area;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.right = {0, 0, 1};
    light.size = size;
    light.intensity = radiance;
    return light;
}

// Lamps under hoods along the right wall, and the sky above each shaft.
void addLights(Tunnel& t) {
    for (int i = 0; i < 4; ++i) {
        const float z = -1.5f - 11.0f * static_cast<float>(i), y = 2.05f, x = halfWidth - 0.3f;
        t.steel.box({x - 0.1f, y, z - 0.24f}, {halfWidth, y + 0.015f, z + 0.24f});
        t.steel.box({x - 0.1f, y - 0.05f, z - 0.24f}, {x - 0.088f, y, z + 0.24f});
        for (const float at : {-0.18f, 0.18f})
            t.steel.rod({x - 0.05f, y + 0.02f, z + at}, {halfWidth, y + 0.22f, z + at}, 0.012f, 8);
        t.scene.lights.push_back(areaLight("lamp " + std::to_string(i + 1), {x + 0.03f, y - 0.02f, z},
                                           {-0.35f, -1.0f, 0.0f}, {0.42f, 0.16f},
                                           11.0f * glm::vec3(1.0f, 0.66f, 0.34f)));
    }
    for (size_t i = 0; i < shafts.size(); ++i)
        t.scene.lights.push_back(areaLight("sky " + std::to_string(i + 1), {0.0f, street - 0.12f, shafts[i]},
                                           {0, -1, 0}, glm::vec2(2.0f * shaftHalf), {2.2f, 2.9f, 3.9f}));
    t.scene.lights.push_back(makeSun({0.2f, -1.0f, 0.1f}, 26.0f * glm::vec3(1.0f, 0.95f, 0.86f)));
}

} // namespace

Scene makeTunnel() {
    Tunnel tunnel;
    addShell(tunnel);
    addShafts(tunnel);
    addWalkway(tunnel);
    addRailing(tunnel);
    addPipes(tunnel);
    addValve(tunnel);
    addLights(tunnel);
    tunnel.camera("railing", {1.3f, 1.35f, 1.2f}, {-0.5f, 0.75f, -9.0f}, 60.0f, 0.03f, 100.0f);
    tunnel.camera("grating", {1.75f, 0.28f, 2.6f}, {0.9f, 0.45f, -8.0f}, 55.0f, 0.03f, 100.0f);
    tunnel.camera("ledge", {-1.95f, 1.2f, -11.0f}, {1.6f, 1.0f, -20.0f}, 62.0f, 0.03f, 100.0f);
    return tunnel.take();
}

} // namespace rebound::lab
