// SPDX-License-Identifier: MIT
// A street of a small town that leads to a square with a tower, hills behind it: sun on one side, shadow on the other, from
// 0.5 m to 600 m. A scene to judge by: no setting is chosen by what it shows.
#include "lab/scenes/scene_files.hpp"

#include "lab/scenes/atrium_parts.hpp"
#include "lab/scenes/street_parts.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace rebound::lab {
namespace {

void addHouses(Street& s) {
    constexpr std::array<House, 7> left = {House{-9.0f, 8.0f, 2, 2, 0, false}, {-1.0f, 7.0f, 1, 0, 1, true},
                                           {6.0f, 5.2f, 3, 1, 0, false},       {11.2f, 8.4f, 2, 4, 2, true},
                                           {19.6f, 6.0f, 2, 0, 0, false},      {25.6f, 7.6f, 3, 2, 1, false},
                                           {33.2f, 6.4f, 1, 1, 2, true}};
    constexpr std::array<House, 6> right = {
        House{-8.0f, 9.4f, 2, 0, 2, false}, {1.4f, 6.2f, 3, 3, 0, true},   {7.6f, 7.8f, 1, 1, 1, false},
        {15.4f, 6.2f, 2, 2, 0, true},       {21.6f, 8.2f, 3, 4, 2, false}, {29.8f, 9.0f, 2, 0, 1, false}};
    for (const House& house : left) addHouse(s, house, placedAt({-front, pavement, -house.begin}, 90.0f));
    for (const House& house : right)
        addHouse(s, house, placedAt({front, pavement, -house.begin - house.width}, -90.0f));
}

void addGround(Street& s) {
    s.cobbles.box({-kerb, -0.3f, -110.0f}, {kerb, 0.0f, 12.0f});
    s.cobbles.box({-40.0f, -0.3f, -110.0f}, {-kerb, 0.0f, -39.6f});
    s.cobbles.box({kerb, -0.3f, -110.0f}, {40.0f, 0.0f, -39.6f});
    for (const float side : {-1.0f, 1.0f}) {
        const float near = side * kerb, far = side * 14.0f, edge = side * (kerb + 0.18f);
        s.stone.box({std::min(near, edge), -0.3f, -39.6f}, {std::max(near, edge), pavement, 12.0f});
        s.slabs.box({std::min(edge, far), -0.3f, -39.6f}, {std::max(edge, far), pavement, 12.0f});
    }
}

void addLampPost(Street& s, const glm::vec3& foot) {
    const std::array<glm::vec2, 10> post = {glm::vec2(0, 0), {0.16f, 0},     {0.16f, 0.12f}, {0.09f, 0.3f},
                                            {0.07f, 0.9f},   {0.045f, 1.0f}, {0.035f, 3.3f}, {0.08f, 3.36f},
                                            {0.08f, 3.42f},  {0, 3.42f}};
    s.iron.revolve(post, foot, 16);
    const std::array<glm::vec2, 6> glass = {glm::vec2(0, 3.42f), {0.1f, 3.42f},  {0.17f, 3.82f},
                                            {0.16f, 3.84f},      {0.05f, 3.85f}, {0, 3.85f}};
    s.paint.revolve(glass, foot, 8);
    const std::array<glm::vec2, 6> hood = {glm::vec2(0, 3.86f), {0.22f, 3.86f}, {0.2f, 3.9f},
                                           {0.06f, 4.02f},      {0.02f, 4.12f}, {0, 4.14f}};
    s.iron.revolve(hood, foot, 8);
}

// A trunk, branches, and clusters of leaves around their ends.
void addTree(Street& s, const glm::vec3& foot, float height, int seed) {
    const std::array<glm::vec2, 5> trunk = {
        glm::vec2(0, 0), {0.2f, 0}, {0.13f, 0.4f}, {0.1f, height * 0.55f}, {0, height * 0.55f}};
    s.bark.revolve(trunk, foot, 12);
    for (int i = 0; i < 9; ++i) {
        const float turn = 2.4f * static_cast<float>(i + seed),
                    reach = 0.9f + 0.25f * static_cast<float>((i * 5 + seed) % 4);
        const glm::vec3 from = foot + glm::vec3(0, height * (0.36f + 0.02f * static_cast<float>(i)), 0);
        const glm::vec3 to =
            from + glm::vec3(reach * std::cos(turn), height * (0.16f + 0.03f * static_cast<float>(i % 4)),
                             reach * std::sin(turn));
        s.bark.rod(from, to, 0.035f, 6);
        for (int k = 0; k < 3; ++k)
            addPlant(
                s.leaf, from + (to - from) * (0.55f + 0.25f * static_cast<float>(k)) - glm::vec3(0, 0.25f, 0),
                0.75f + 0.1f * static_cast<float>((i + k) % 3), 22, static_cast<float>(7 * i + k + seed));
    }
    s.stone.box(foot + glm::vec3(-0.7f, -0.02f, -0.7f), foot + glm::vec3(0.7f, 0.05f, 0.7f));
}

// At the far end of the square: a church tower with a pointed roof, and its nave.
void addTower(Street& s) {
    const glm::vec3 foot(-3.0f, 0.0f, -92.0f);
    s.stone.box(foot + glm::vec3(-4, 0, -4), foot + glm::vec3(4, 26, 4));
    for (const float y : {9.0f, 17.5f, 25.4f})
        s.stone.box(foot + glm::vec3(-4.3f, y, -4.3f), foot + glm::vec3(4.3f, y + 0.6f, 4.3f));
    for (const float x : {-2.6f, -0.6f, 1.4f})
        s.pane.box(foot + glm::vec3(x, 19.5f, 3.9f), foot + glm::vec3(x + 1.2f, 24.0f, 4.04f));
    s.wood.box(foot + glm::vec3(-1.2f, 0, 3.9f), foot + glm::vec3(1.2f, 4.2f, 4.1f));
    const std::array<glm::vec2, 4> spire = {glm::vec2(0, 26.0f), {4.9f, 26.0f}, {0.12f, 42.0f}, {0, 42.2f}};
    s.roof.place(placedAt(foot, 22.5f));
    s.roof.revolve(spire, glm::vec3(0.0f), 8);
    s.roof.place(glm::mat4(1.0f));
    s.walls[2]->box(foot + glm::vec3(4, 0, -26), foot + glm::vec3(16, 11, -2));
    const std::array<glm::vec3, 3> east = {foot + glm::vec3(16.4f, 11, -1.6f),
                                           foot + glm::vec3(3.6f, 11, -1.6f),
                                           foot + glm::vec3(10, 17, -1.6f)};
    std::array<glm::vec3, 3> west = {east[1], east[0], east[2]};
    for (glm::vec3& p : west) p.z = foot.z - 26.4f;
    s.roof.face(std::array<glm::vec3, 3>{east[1], east[0], east[2]});
    s.roof.face(std::array<glm::vec3, 3>{west[1], west[0], west[2]});
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec3 a = east[i], b = east[(i + 1) % 3];
        const std::array<glm::vec3, 4> side = {a, b, {b.x, b.y, foot.z - 26.4f}, {a.x, a.y, foot.z - 26.4f}};
        s.roof.face(side);
    }
    for (int i = 0; i < 5; ++i) {
        const float x = -34.0f + 15.0f * static_cast<float>(i) + (i > 1 ? 12.0f : 0.0f);
        addHouse(s, {0, 12.5f, 1 + i % 3, i, i % 3, false}, placedAt({x, 0.0f, -104.0f}, 0.0f));
    }
}

// Ridges of hills, each farther and higher; their sheets are open below the horizon.
void addHills(Street& s) {
    int row = 0;
    for (const auto& [distance, height, mesh] :
         {std::tuple{150.0f, 16.0f, &s.hills}, std::tuple{280.0f, 48.0f, &s.forest},
          std::tuple{520.0f, 95.0f, &s.hills}}) {
        const float d = distance, h = height, phase = 1.7f * static_cast<float>(++row);
        const auto heightAt = [=](float x, float across) {
            const float along = x / d;
            return h *
                   (0.55f + 0.25f * std::sin(3.1f * along + phase) +
                    0.2f * std::sin(7.3f * along + 2.0f * phase)) *
                   std::sin(across * std::numbers::pi_v<float>);
        };
        const auto at = [=](float u, float v) {
            const float x = (u - 0.5f) * 2.4f * d;
            return glm::vec3(x, heightAt(x, v) - 0.5f, -d + 0.35f * d * (0.5f - v));
        };
        mesh->sheet(48, 8,
                    [&](float u, float v) {
                        const glm::vec3 du = at(u + 0.005f, v) - at(u - 0.005f, v),
                                        dv = at(u, v + 0.01f) - at(u, v - 0.01f);
                        return MeshPoint{at(u, v), glm::cross(du, dv)};
                    },
                    {1, 1});
    }
    s.meadow.box({-420.0f, -1.2f, -560.0f}, {420.0f, -0.32f, 60.0f});
}

// What a path may move: a delivery van.
void addVan(Street& s) {
    const glm::mat4 place = placedAt({1.45f, 0.0f, -24.0f});
    MeshBuilder& body = s.object("van", "enamel");
    MeshBuilder& glass = s.object("van", "panes");
    MeshBuilder& tyres = s.object("van", "iron");
    for (MeshBuilder* part : {&body, &glass, &tyres}) part->place(place);
    const std::array<glm::vec2, 8> outline = {glm::vec2(1.9f, 0.4f), {1.95f, 0.95f}, {1.35f, 1.15f},
                                              {0.95f, 1.9f},         {0.7f, 2.05f},  {-1.9f, 2.05f},
                                              {-2.0f, 1.9f},         {-2.0f, 0.4f}};
    // (z, y) turns from the front over the roof to the back.
    std::array<glm::vec3, 8> left, right;
    for (size_t i = 0; i < 8; ++i) {
        left[7 - i] = {-0.9f, outline[i].y, outline[i].x};
        right[i] = {0.9f, outline[i].y, outline[i].x};
    }
    body.face(std::array<glm::vec3, 8>{right[7], right[6], right[5], right[4], right[3], right[2], right[1],
                                       right[0]});
    body.face(
        std::array<glm::vec3, 8>{left[7], left[6], left[5], left[4], left[3], left[2], left[1], left[0]});
    for (size_t i = 0; i < 8; ++i) {
        const glm::vec3 a = right[i], b = right[(i + 1) % 8];
        const std::array<glm::vec3, 4> panel = {a, b, {-b.x, b.y, b.z}, {-a.x, a.y, a.z}};
        body.face(panel);
    }
    glass.box({-0.91f, 1.2f, 0.15f}, {0.91f, 1.75f, 0.85f});
    glass.box({-0.7f, 1.25f, -2.02f}, {0.7f, 1.75f, -1.9f});
    for (const float x : {-0.92f, 0.72f})
        for (const float z : {-1.3f, 1.25f}) tyres.rod({x, 0.33f, z}, {x + 0.2f, 0.33f, z}, 0.33f, 24);
}

// Round tables and chairs before the café, bollards, a bench, pots.
void addFurniture(Street& s) {
    for (const float z : {-2.4f, -4.6f}) {
        const glm::vec3 foot(-3.75f, pavement, z);
        const std::array<glm::vec2, 8> table = {glm::vec2(0, 0), {0.2f, 0},       {0.2f, 0.02f},
                                                {0.025f, 0.04f}, {0.025f, 0.71f}, {0.34f, 0.715f},
                                                {0.34f, 0.74f},  {0, 0.74f}};
        s.iron.revolve(table, foot, 28);
        for (const float side : {-1.0f, 1.0f}) {
            MeshBuilder& chair = s.wood;
            chair.place(placedAt(foot + glm::vec3(0.1f, 0, side * 0.62f), side > 0 ? 8.0f : 188.0f));
            chair.box({-0.2f, 0.43f, -0.2f}, {0.2f, 0.46f, 0.2f});
            for (int slat = 0; slat < 4; ++slat) {
                const float y = 0.56f + 0.085f * static_cast<float>(slat);
                chair.box({-0.19f, y, 0.185f}, {0.19f, y + 0.05f, 0.2f});
            }
            chair.place(glm::mat4(1.0f));
            s.iron.place(placedAt(foot + glm::vec3(0.1f, 0, side * 0.62f), side > 0 ? 8.0f : 188.0f));
            for (const float x : {-0.18f, 0.18f}) {
                s.iron.rod({x, 0.0f, -0.18f}, {x, 0.44f, -0.16f}, 0.011f, 8);
                s.iron.rod({x, 0.0f, 0.21f}, {x, 0.9f, 0.21f}, 0.011f, 8);
            }
            s.iron.place(glm::mat4(1.0f));
        }
    }
    const std::array<glm::vec2, 7> bollard = {glm::vec2(0, 0), {0.1f, 0},      {0.09f, 0.7f}, {0.115f, 0.76f},
                                              {0.1f, 0.84f},   {0.05f, 0.89f}, {0, 0.9f}};
    for (int i = 0; i < 9; ++i)
        for (const float side : {-1.0f, 1.0f})
            s.iron.revolve(bollard, {side * (kerb + 0.4f), pavement, 3.0f - 5.2f * static_cast<float>(i)},
                           14);
    for (const float z : {-9.5f, -15.4f, -27.5f}) {
        addVase(s.terracotta, {3.9f, pavement, z}, 0.6f);
        addPlant(s.leaf, {3.9f, pavement + 0.45f, z}, 0.9f, 34, z);
    }
    const float z = -12.4f;
    for (int slat = 0; slat < 4; ++slat)
        s.wood.box({3.55f + 0.1f * static_cast<float>(slat), pavement + 0.44f, z},
                   {3.63f + 0.1f * static_cast<float>(slat), pavement + 0.475f, z + 1.5f});
    for (const float end : {z + 0.15f, z + 1.3f})
        s.iron.box({3.57f, pavement, end}, {3.9f, pavement + 0.44f, end + 0.05f});
    // A line of bunting over the street.
    for (int i = 0; i < 24; ++i) {
        const auto at = [](int k) {
            const float t = static_cast<float>(k) / 24.0f;
            return glm::vec3(-front + 2.0f * front * t, 7.0f - 2.2f * t * (1.0f - t), -10.0f);
        };
        s.iron.rod(at(i), at(i + 1), 0.008f, 6);
    }
}

} // namespace

Scene makeStreet() {
    Street street;
    addGround(street);
    addHouses(street);
    for (const float z : {-3.6f, -18.4f, -33.2f}) addLampPost(street, {-3.35f, pavement, z});
    for (const float z : {-11.0f, -26.0f}) addLampPost(street, {3.35f, pavement, z});
    addTree(street, {9.0f, 0.0f, -52.0f}, 6.5f, 1);
    addTree(street, {-10.5f, 0.0f, -58.0f}, 7.5f, 4);
    addTree(street, {14.0f, 0.0f, -70.0f}, 7.0f, 9);
    addTower(street);
    addHills(street);
    addVan(street);
    addFurniture(street);
    street.scene.lights = {makeSun({-0.62f, -0.72f, -0.42f}, 22.0f * glm::vec3(1.0f, 0.93f, 0.8f))};
    street.scene.environment = {0.75f, 1.0f, 1.45f};
    street.camera("cafe", {-2.55f, 1.45f, 0.35f}, {-1.9f, 1.7f, -14.0f}, 58.0f, 0.05f, 1500.0f);
    street.camera("crossing", {1.1f, 1.65f, 5.5f}, {-0.6f, 2.9f, -20.0f}, 55.0f, 0.05f, 1500.0f);
    street.camera("square", {-12.0f, 2.2f, -44.0f}, {5.0f, 4.2f, -75.0f}, 60.0f, 0.05f, 1500.0f);
    return street.take();
}

} // namespace rebound::lab