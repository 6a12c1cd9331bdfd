// SPDX-License-Identifier: MIT
// A small furnished room in the morning, seen from near: things of 2 cm to 3 m, lit by a low sun through its window, by the
// sky and by a desk lamp. A scene to judge by: no setting is chosen by what it shows.
#include "lab/scenes/scene_files.hpp"

#include "lab/scenes/atrium_parts.hpp"
#include "lab/scenes/builtin_textures.hpp"
#include "lab/scenes/scene_builder.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

namespace rebound::lab {
namespace {

// Half extents of the room's floor, and its height [m].
constexpr float halfX = 1.9f, halfZ = 1.6f, height = 2.5f, wall = 0.2f;
constexpr float deskTop = 0.74f, deskBack = -1.58f;

struct Study : SceneBuilder {
    Study() : SceneBuilder("study") {}

    MeshBuilder& plaster = surface("plaster", {0.74f, 0.7f, 0.62f});
    MeshBuilder& ceiling = surface("ceiling", {0.82f, 0.81f, 0.78f});
    MeshBuilder& floor =
        surface("floor", glm::vec3(1.0f),
                texture(makePlankTexture("boards", {{0.5f, 0.33f, 0.19f}, {0.3f, 0.18f, 0.09f}},
                                         {0.08f, 0.05f, 0.03f})),
                0.9f);
    MeshBuilder& carpet = surface("carpet", glm::vec3(1.0f),
                                  texture(makeCarpetTexture("carpet", {0.42f, 0.07f, 0.06f},
                                                            {0.62f, 0.48f, 0.24f}, {0.07f, 0.1f, 0.24f})),
                                  1.0f / 1.8f);
    MeshBuilder& oak =
        surface("oak", glm::vec3(1.0f),
                texture(makePlankTexture("oak", {{0.46f, 0.27f, 0.13f}, {0.34f, 0.19f, 0.085f}},
                                         {0.3f, 0.16f, 0.07f})),
                1.3f);
    MeshBuilder& white = surface("white paint", {0.8f, 0.79f, 0.76f});
    MeshBuilder& paper = surface("paper", {0.78f, 0.75f, 0.66f});
    MeshBuilder& brass = surface("brass", {0.58f, 0.42f, 0.17f});
    MeshBuilder& iron = surface("iron", {0.06f, 0.06f, 0.065f});
    MeshBuilder& red = surface("red", {0.55f, 0.06f, 0.05f});
    MeshBuilder& blue = surface("blue", {0.06f, 0.14f, 0.42f});
    MeshBuilder& green = surface("green", {0.08f, 0.28f, 0.12f});
    MeshBuilder& ochre = surface("ochre", {0.62f, 0.4f, 0.1f});
    MeshBuilder& curtain = surface("curtain", {0.66f, 0.42f, 0.26f});
    MeshBuilder& terracotta = surface("terracotta", {0.55f, 0.24f, 0.13f});
    MeshBuilder& leaf = surface("leaves", {0.1f, 0.3f, 0.07f});
    MeshBuilder& sea = surface("sea", {0.1f, 0.3f, 0.5f});
    MeshBuilder& land =
        surface("land and sea", glm::vec3(1.0f),
                texture(makeStoneTexture("map", {{0.5f, 0.42f, 0.2f}, {0.04f, 0.2f, 0.38f}})), 1.0f);
    MeshBuilder& darkWood = surface("dark wood", {0.13f, 0.065f, 0.035f});
};

void addRoom(Study& s) {
    const float x = halfX, z = halfZ, out = wall;
    s.floor.box({-x - out, -0.1f, -z - out}, {x + out, 0.0f, z + out});
    s.ceiling.box({-x - out, height, -z - out}, {x + out, height + 0.1f, z + out});
    s.plaster.box({-x, 0.0f, -z - out}, {x, height, -z});
    s.plaster.box({-x, 0.0f, z}, {x, height, z + out});
    s.plaster.box({x, 0.0f, -z - out}, {x + out, height, z + out});
    // The window's wall, around its opening.
    constexpr float low = 0.85f, high = 2.15f, begin = -0.75f, end = 0.65f;
    s.plaster.box({-x - out, 0.0f, -z - out}, {-x, low, z + out});
    s.plaster.box({-x - out, high, -z - out}, {-x, height, z + out});
    s.plaster.box({-x - out, low, -z - out}, {-x, high, begin});
    s.plaster.box({-x - out, low, end}, {-x, high, z + out});
    // Its frame, its bars and its sill.
    const float face = -x - 0.14f;
    for (const float at : {begin, (begin + end) / 2.0f - 0.025f, end - 0.05f})
        s.white.box({face, low, at}, {face + 0.05f, high, at + 0.05f});
    for (const float at : {low, 1.5f, high - 0.05f})
        s.white.box({face + 0.005f, at, begin}, {face + 0.045f, at + 0.04f, end});
    s.white.box({-x - 0.09f, low - 0.03f, begin - 0.06f}, {-x + 0.12f, low + 0.005f, end + 0.06f});
    // Skirting boards, and a rail for pictures.
    for (const auto& [bottom, top, depth] :
         {std::tuple{0.0f, 0.09f, 0.018f}, std::tuple{2.22f, 2.26f, 0.02f}}) {
        s.white.box({-x, bottom, -z}, {x, top, -z + depth});
        s.white.box({-x, bottom, z - depth}, {x, top, z});
        s.white.box({x - depth, bottom, -z + depth}, {x, top, z - depth});
    }
    s.white.box({-x, 0.0f, -z + 0.018f}, {-x + 0.018f, 0.09f, z - 0.018f});
    s.carpet.place(placedAt({-0.75f, 0.0f, -0.65f}));
    s.carpet.box({0, 0, 0}, {1.8f, 0.012f, 1.8f});
}

void addCurtains(Study& s) {
    const WallPlane plane{{-halfX + 0.12f, 0, -0.05f}, {0, 0, -1}, {1, 0, 0}};
    addDrape(s.curtain, plane, {0.88f, 0.42f, 2.28f, 0.12f, 2.0f, 0.4f});
    addDrape(s.curtain, plane, {-0.88f, 0.42f, 2.28f, 0.12f, 2.0f, 2.0f});
    s.brass.rod({-halfX + 0.12f, 2.3f, -1.25f}, {-halfX + 0.12f, 2.3f, 1.15f}, 0.012f, 10);
}

void addDesk(Study& s) {
    constexpr float left = -0.95f, right = 0.65f, front = deskBack + 0.72f;
    s.oak.box({left, deskTop - 0.035f, deskBack}, {right, deskTop, front});
    s.oak.box({left + 0.03f, deskTop - 0.13f, deskBack + 0.03f},
              {right - 0.03f, deskTop - 0.035f, front - 0.04f});
    for (const float x : {left + 0.05f, right - 0.11f})
        for (const float z : {deskBack + 0.04f, front - 0.1f})
            s.oak.box({x, 0.0f, z}, {x + 0.06f, deskTop - 0.13f, z + 0.06f});
    s.oak.box({right - 0.48f, 0.12f, deskBack + 0.06f}, {right - 0.12f, deskTop - 0.13f, front - 0.06f});
    for (const float y : {0.16f, 0.33f, 0.5f}) {
        s.oak.box({right - 0.46f, y, front - 0.06f}, {right - 0.14f, y + 0.14f, front - 0.04f});
        s.brass.rod({right - 0.3f, y + 0.07f, front - 0.04f}, {right - 0.3f, y + 0.07f, front - 0.01f},
                    0.012f, 8);
    }
}

void addLamp(Study& s) {
    const glm::vec3 foot(-0.72f, deskTop, deskBack + 0.24f);
    const std::array<glm::vec2, 5> base = {
        glm::vec2(0, 0), {0.085f, 0}, {0.085f, 0.012f}, {0.02f, 0.028f}, {0, 0.028f}};
    s.brass.revolve(base, foot, 24);
    const glm::vec3 elbow = foot + glm::vec3(-0.06f, 0.3f, -0.04f),
                    head = foot + glm::vec3(0.2f, 0.43f, 0.1f);
    s.brass.rod(foot, elbow, 0.007f, 10);
    s.brass.rod(elbow, head, 0.007f, 10);
    const std::array<glm::vec2, 7> joint = {
        glm::vec2(0, -0.014f), {0.012f, -0.009f}, {0.015f, 0}, {0.012f, 0.009f},
        {0, 0.014f},           {0, 0.014f},       {0, 0.014f}};
    s.brass.revolve(std::span(joint).first(5), elbow, 12);
    const std::array<glm::vec2, 6> shade = {glm::vec2(0, -0.005f), {0.022f, -0.01f}, {0.095f, -0.115f},
                                            {0.1f, -0.115f},       {0.03f, 0.012f},  {0, 0.015f}};
    s.green.revolve(shade, head, 32);
}

// Upright in its own space, its spine towards +z: thick along x, tall along y, deep along z.
void addBook(Study& s, MeshBuilder& cover, const glm::mat4& place, const glm::vec3& size) {
    constexpr float board = 0.0025f, inset = 0.004f;
    for (MeshBuilder* part : {&cover, &s.paper}) part->place(place);
    cover.box({0, 0, 0}, {board, size.y, size.z});
    cover.box({size.x - board, 0, 0}, size);
    cover.box({board, 0, size.z - board}, {size.x - board, size.y, size.z});
    s.paper.box({board, inset, inset}, {size.x - board, size.y - inset, size.z - board});
    for (MeshBuilder* part : {&cover, &s.paper}) part->place(glm::mat4(1.0f));
}

MeshBuilder& coverOf(Study& s, int number) {
    const std::array<MeshBuilder*, 7> covers = {&s.red,        &s.blue, &s.green, &s.ochre,
                                                &s.terracotta, &s.iron, &s.sea};
    return *covers[static_cast<size_t>(number) % covers.size()];
}

void addBookRow(Study& s, const glm::mat4& place, const glm::vec3& from, float length, int seed) {
    float at = 0.0f;
    for (int i = 0; at < length - 0.06f; ++i) {
        const int mixed = (i * 7 + seed * 11) * 37 % 101;
        const glm::vec3 size(0.018f + 0.00026f * static_cast<float>(mixed),
                             0.19f + 0.0011f * static_cast<float>((mixed * 17) % 97),
                             0.14f + 0.0006f * static_cast<float>((mixed * 29) % 89));
        addBook(s, coverOf(s, mixed + 3 * i), place * placedAt(from + glm::vec3(at, 0, 0)), size);
        at += size.x + 0.001f + (mixed % 17 == 0 ? 0.06f : 0.0f);
    }
}

// Against the wall opposite the window. In their own space x runs along them, and z into the room.
void addShelves(Study& s) {
    constexpr float width = 1.5f, depth = 0.3f, top = 2.05f, side = 0.025f;
    const glm::mat4 place = placedAt({halfX - 0.02f, 0.0f, -0.55f}, -90.0f);
    s.oak.place(place);
    s.oak.box({0, 0, 0}, {side, top, depth});
    s.oak.box({width - side, 0, 0}, {width, top, depth});
    s.oak.box({side, 0, 0}, {width - side, top, 0.012f});
    const std::array<float, 6> levels = {0.06f, 0.45f, 0.84f, 1.23f, 1.62f, 2.02f};
    for (const float y : levels) s.oak.box({side, y, 0.012f}, {width - side, y + side, depth - 0.01f});
    s.oak.place(glm::mat4(1.0f));
    for (int i = 0; i < 5; ++i) {
        const float begin = i % 2 == 0 ? 0.03f : 0.22f;
        addBookRow(s, place, {begin, levels[static_cast<size_t>(i)] + side, 0.02f}, i == 3 ? 0.7f : 1.2f, i);
    }
    const std::array<glm::vec2, 8> vase = {glm::vec2(0, 0), {0.05f, 0},      {0.075f, 0.06f}, {0.07f, 0.12f},
                                           {0.03f, 0.2f},   {0.045f, 0.25f}, {0.03f, 0.25f},  {0, 0.2f}};
    s.sea.revolve(vase, glm::vec3(place * glm::vec4(1.15f, 1.255f, 0.15f, 1.0f)), 28);
}

// Two curved halves on a board, open on the desk.
void addOpenBook(Study& s) {
    const glm::mat4 place = placedAt({-0.22f, deskTop, deskBack + 0.44f}, 12.0f);
    s.red.place(place);
    s.red.box({-0.155f, 0.0f, -0.115f}, {0.155f, 0.004f, 0.115f});
    s.red.place(glm::mat4(1.0f));
    s.paper.place(place);
    for (const float side : {-1.0f, 1.0f}) {
        constexpr int strips = 8;
        std::vector<glm::vec2> outline;
        for (int i = 0; i <= strips; ++i) {
            const float t = static_cast<float>(i) / strips;
            outline.emplace_back(side * 0.15f * t, 0.006f + 0.022f * std::sqrt(t) * (1.0f - 0.75f * t));
        }
        for (int i = 0; i < strips; ++i) {
            const glm::vec2 a = outline[static_cast<size_t>(i)], b = outline[static_cast<size_t>(i) + 1];
            const glm::vec2 left = side > 0 ? a : b, right = side > 0 ? b : a;
            const std::array<glm::vec3, 4> top = {glm::vec3(left.x, left.y, 0.11f),
                                                  {right.x, right.y, 0.11f},
                                                  {right.x, right.y, -0.11f},
                                                  {left.x, left.y, -0.11f}};
            const std::array<glm::vec3, 4> front = {glm::vec3(left.x, 0.004f, 0.11f),
                                                    {right.x, 0.004f, 0.11f},
                                                    {right.x, right.y, 0.11f},
                                                    {left.x, left.y, 0.11f}};
            const std::array<glm::vec3, 4> back = {glm::vec3(right.x, 0.004f, -0.11f),
                                                   {left.x, 0.004f, -0.11f},
                                                   {left.x, left.y, -0.11f},
                                                   {right.x, right.y, -0.11f}};
            const std::array<glm::vec3, 4> under = {glm::vec3(left.x, 0.004f, -0.11f),
                                                    {right.x, 0.004f, -0.11f},
                                                    {right.x, 0.004f, 0.11f},
                                                    {left.x, 0.004f, 0.11f}};
            for (const auto& part : {top, front, back, under}) s.paper.face(part);
        }
        const glm::vec2 end = outline.back(), first = outline.front();
        for (const auto& [at, outwards] : {std::pair{end, side}, std::pair{first, -side}}) {
            const float z = outwards > 0 ? 0.11f : -0.11f;
            const std::array<glm::vec3, 4> edge = {
                glm::vec3(at.x, 0.004f, z), {at.x, 0.004f, -z}, {at.x, at.y, -z}, {at.x, at.y, z}};
            s.paper.face(edge);
        }
    }
    s.paper.place(glm::mat4(1.0f));
}

std::vector<glm::vec2> ballProfile(float radius, int bands) {
    std::vector<glm::vec2> profile;
    for (int i = 0; i <= bands; ++i) {
        const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(bands);
        profile.emplace_back(i == 0 || i == bands ? 0.0f : radius * std::sin(angle),
                             -radius * std::cos(angle));
    }
    return profile;
}

// What a path may move: a ball with land on it, about its vertical axis.
void addGlobe(Study& s) {
    const glm::vec3 foot(0.42f, deskTop, deskBack + 0.26f), middle = foot + glm::vec3(0, 0.19f, 0);
    const std::array<glm::vec2, 6> base = {glm::vec2(0, 0), {0.08f, 0},      {0.08f, 0.01f},
                                           {0.02f, 0.025f}, {0.008f, 0.06f}, {0, 0.06f}};
    s.brass.revolve(base, foot, 24);
    for (int i = 0; i < 14; ++i) {
        const auto at = [&](int k) {
            const float angle =
                -0.5f * std::numbers::pi_v<float> + std::numbers::pi_v<float> * static_cast<float>(k) / 14.0f;
            return middle + 0.135f * glm::vec3(std::cos(angle), std::sin(angle), 0.0f);
        };
        s.brass.rod(at(i), at(i + 1), 0.005f, 8);
    }
    s.object("globe", "land and sea").revolve(ballProfile(0.125f, 18), middle, 36);
}

void addThingsOnDesk(Study& s) {
    const glm::vec3 mug(0.12f, deskTop, deskBack + 0.5f);
    const std::array<glm::vec2, 8> cup = {glm::vec2(0, 0), {0.034f, 0},      {0.038f, 0.01f}, {0.04f, 0.09f},
                                          {0.037f, 0.09f}, {0.034f, 0.014f}, {0.03f, 0.01f},  {0, 0.01f}};
    s.white.revolve(cup, mug, 32);
    for (int i = 0; i < 8; ++i) {
        const auto at = [&](int k) {
            const float angle = -1.2f + 2.4f * static_cast<float>(k) / 8.0f;
            return mug +
                   glm::vec3(0.028f + 0.032f * std::cos(angle), 0.048f + 0.032f * std::sin(angle), 0.0f);
        };
        s.white.rod(at(i), at(i + 1), 0.005f, 8);
    }
    const glm::vec3 pot(-0.5f, deskTop, deskBack + 0.14f);
    const std::array<glm::vec2, 6> holder = {glm::vec2(0, 0), {0.036f, 0},      {0.036f, 0.1f},
                                             {0.032f, 0.1f},  {0.032f, 0.006f}, {0, 0.006f}};
    s.terracotta.revolve(holder, pot, 24);
    const std::array<MeshBuilder*, 5> pencils = {&s.ochre, &s.red, &s.blue, &s.green, &s.iron};
    for (size_t i = 0; i < pencils.size(); ++i) {
        const float angle = 1.3f * static_cast<float>(i);
        const glm::vec3 lean(std::cos(angle), 0.0f, std::sin(angle));
        pencils[i]->rod(pot + glm::vec3(0, 0.007f, 0) - 0.02f * lean,
                        pot + 0.03f * lean + glm::vec3(0, 0.165f, 0), 0.0035f, 6);
    }
    // A stack of books that lie on their sides.
    float y = deskTop;
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 size(0.028f + 0.006f * static_cast<float>(i), 0.25f - 0.02f * static_cast<float>(i),
                             0.18f);
        const glm::mat4 lying = placedAt({0.46f, y, deskBack + 0.66f}, 72.0f + 9.0f * static_cast<float>(i)) *
                                glm::mat4(glm::vec4(0, 1, 0, 0), glm::vec4(-1, 0, 0, 0),
                                          glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 0, 1));
        addBook(s, coverOf(s, 2 * i + 1), lying, size);
        y += size.x;
    }
    s.paper.place(placedAt({-0.6f, deskTop, deskBack + 0.52f}, -8.0f));
    for (const float sheet : {0.0f, 0.0012f, 0.0024f})
        s.paper.box({-0.105f + 4 * sheet, sheet, -0.148f}, {0.105f + 4 * sheet, sheet + 0.001f, 0.148f});
    s.paper.place(glm::mat4(1.0f));
}

// What a path may move.
void addChair(Study& s) {
    MeshBuilder& chair = s.object("chair", "dark wood");
    chair.place(placedAt({-0.05f, 0.0f, -0.32f}, 24.0f));
    constexpr float half = 0.21f, seat = 0.45f;
    for (const float x : {-half, half - 0.036f})
        for (const float z : {-half, half - 0.036f})
            chair.box({x, 0.0f, z}, {x + 0.036f, z > 0 ? 0.92f : seat, z + 0.036f});
    chair.box({-half - 0.01f, seat, -half - 0.015f}, {half + 0.01f, seat + 0.028f, half - 0.036f});
    chair.box({-half + 0.036f, 0.84f, half - 0.03f}, {half - 0.036f, 0.92f, half - 0.006f});
    chair.box({-half + 0.036f, 0.56f, half - 0.03f}, {half - 0.036f, 0.6f, half - 0.006f});
    for (int i = 0; i < 5; ++i) {
        const float x = -0.14f + 0.07f * static_cast<float>(i);
        chair.rod({x, 0.6f, half - 0.018f}, {x, 0.84f, half - 0.018f}, 0.009f, 10);
    }
    for (const float x : {-half + 0.018f, half - 0.018f})
        chair.rod({x, 0.2f, -half + 0.036f}, {x, 0.2f, half - 0.036f}, 0.012f, 10);
    MeshBuilder& cushion = s.object("chair", "red");
    cushion.place(placedAt({-0.05f, seat + 0.028f, -0.33f}, 24.0f));
    const std::array<glm::vec2, 7> round = {glm::vec2(0, 0),  {0.15f, 0},       {0.172f, 0.012f},
                                            {0.175f, 0.022f}, {0.165f, 0.036f}, {0.12f, 0.044f},
                                            {0, 0.046f}};
    cushion.revolve(round, glm::vec3(0.0f), 32);
}

// On the wall behind the desk: low left corner and size, its frame and its fields of colour.
void addPicture(Study& s, glm::vec2 low, glm::vec2 size, std::array<MeshBuilder*, 3> fields) {
    const float z = -halfZ, edge = 0.028f;
    const glm::vec2 high = low + size;
    s.oak.box({low.x, low.y, z}, {high.x, low.y + edge, z + 0.03f});
    s.oak.box({low.x, high.y - edge, z}, {high.x, high.y, z + 0.03f});
    s.oak.box({low.x, low.y + edge, z}, {low.x + edge, high.y - edge, z + 0.03f});
    s.oak.box({high.x - edge, low.y + edge, z}, {high.x, high.y - edge, z + 0.03f});
    s.white.box({low.x + edge, low.y + edge, z}, {high.x - edge, high.y - edge, z + 0.006f});
    const glm::vec2 inner = low + edge + 0.04f, span = size - 2.0f * (edge + 0.04f);
    const std::array<glm::vec2, 4> cuts = {glm::vec2(0, 0), {0, 0.45f}, {0, 0.7f}, {0, 1}};
    for (size_t i = 0; i < 3; ++i)
        fields[i]->box({inner.x, inner.y + span.y * cuts[i].y, z + 0.006f},
                       {inner.x + span.x, inner.y + span.y * cuts[i + 1].y, z + 0.009f});
}

// A cushioned stool and a plant by the window.
void addCorner(Study& s) {
    const std::array<glm::vec2, 8> stool = {glm::vec2(0, 0.04f), {0.24f, 0.04f}, {0.27f, 0.1f},
                                            {0.28f, 0.26f},      {0.26f, 0.36f}, {0.2f, 0.41f},
                                            {0.1f, 0.425f},      {0, 0.43f}};
    s.ochre.revolve(stool, {0.8f, 0.0f, 0.75f}, 40);
    s.oak.rod({0.8f, 0.012f, 0.75f}, {0.8f, 0.05f, 0.75f}, 0.2f, 24);
    addVase(s.terracotta, {-1.45f, 0.0f, -1.25f}, 0.42f);
    addPlant(s.leaf, {-1.45f, 0.3f, -1.25f}, 1.0f, 40, 0.6f);
}

std::vector<Light> lights() {
    Light sky; // of the part of it that the window shows
    sky.name = "window";
    sky.type = LightType::area;
    sky.position = {-halfX - wall - 0.02f, 1.5f, -0.05f};
    sky.direction = {1, 0, 0};
    sky.right = {0, 0, 1};
    sky.size = {1.4f, 1.3f};
    sky.intensity = {1.3f, 1.6f, 2.1f};
    Light lamp;
    lamp.name = "desk lamp";
    lamp.type = LightType::spot;
    lamp.position = {-0.52f, deskTop + 0.36f, deskBack + 0.34f};
    lamp.direction = {0, -1, 0};
    lamp.innerCone = glm::radians(38.0f);
    lamp.outerCone = glm::radians(58.0f);
    lamp.intensity = {0.75f, 0.5f, 0.26f};
    return {makeSun({0.86f, -0.48f, -0.2f}, 14.0f * glm::vec3(1.0f, 0.86f, 0.66f)), sky, lamp};
}

} // namespace

Scene makeStudy() {
    Study study;
    addRoom(study);
    addCurtains(study);
    addDesk(study);
    addLamp(study);
    addShelves(study);
    addOpenBook(study);
    addGlobe(study);
    addThingsOnDesk(study);
    addChair(study);
    addPicture(study, {-0.62f, 1.28f}, {0.5f, 0.62f}, {&study.green, &study.sea, &study.paper});
    addPicture(study, {0.02f, 1.42f}, {0.42f, 0.42f}, {&study.blue, &study.ochre, &study.red});
    addCorner(study);
    study.scene.lights = lights();
    study.camera("desk", {0.15f, 1.28f, -0.22f}, {-0.12f, 0.72f, -1.45f}, 55.0f, 0.02f, 20.0f);
    study.camera("room", {-1.55f, 1.5f, 1.42f}, {0.75f, 0.75f, -0.75f}, 62.0f, 0.02f, 20.0f);
    study.camera("shelves", {-0.1f, 1.25f, 1.25f}, {1.75f, 0.95f, -0.1f}, 50.0f, 0.02f, 20.0f);
    return study.take();
}

} // namespace rebound::lab
