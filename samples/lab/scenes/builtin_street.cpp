// SPDX-License-Identifier: MIT
// A street of a small town that leads to a square with a tower, hills behind it: sun on one side, shadow on the other, from
// 0.5 m to 600 m. A scene to judge by: no setting is chosen by what it shows.
#include "lab/scenes/scene_files.hpp"

#include "lab/scenes/atrium_parts.hpp"
#include "lab/scenes/builtin_textures.hpp"
#include "lab/scenes/scene_builder.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace rebound::lab {
namespace {

// The street runs along -z; its houses' fronts stand at x = -front and front [m].
constexpr float front = 4.6f, kerb = 2.9f, pavement = 0.14f;

struct Street : SceneBuilder {
    Street() : SceneBuilder("street") {}

    int rendering = texture(makeStoneTexture("rendering", {{0.98f, 0.97f, 0.95f}, {0.8f, 0.78f, 0.74f}}));

    MeshBuilder& cobbles =
        surface("cobbles", glm::vec3(1.0f),
                texture(makeMasonryTexture("cobbles", {{0.38f, 0.36f, 0.34f}, {0.2f, 0.19f, 0.185f}},
                                           {0.09f, 0.085f, 0.08f})),
                1.1f);
    MeshBuilder& slabs = surface(
        "slabs", glm::vec3(1.0f),
        texture(makeTileTexture("slabs", {{0.5f, 0.48f, 0.45f}, {0.38f, 0.36f, 0.34f}},
                                {{0.46f, 0.44f, 0.41f}, {0.34f, 0.33f, 0.31f}}, {0.16f, 0.15f, 0.14f})),
        0.55f);
    MeshBuilder& roof =
        surface("roof tiles", glm::vec3(1.0f),
                texture(makeMasonryTexture("roof tiles", {{0.5f, 0.2f, 0.12f}, {0.3f, 0.11f, 0.07f}},
                                           {0.12f, 0.05f, 0.035f})),
                1.2f);
    MeshBuilder& stone =
        surface("stone", glm::vec3(1.0f),
                texture(makeStoneTexture("sandstone", {{0.62f, 0.55f, 0.43f}, {0.44f, 0.38f, 0.29f}})), 0.6f);
    std::array<MeshBuilder*, 5> walls = {&surface("yellow wall", {0.72f, 0.56f, 0.26f}, rendering, 0.4f),
                                         &surface("rose wall", {0.68f, 0.38f, 0.31f}, rendering, 0.4f),
                                         &surface("white wall", {0.74f, 0.72f, 0.67f}, rendering, 0.4f),
                                         &surface("green wall", {0.46f, 0.55f, 0.4f}, rendering, 0.4f),
                                         &surface("blue wall", {0.4f, 0.5f, 0.6f}, rendering, 0.4f)};
    std::array<MeshBuilder*, 3> shutters = {&surface("green shutters", {0.06f, 0.2f, 0.12f}),
                                            &surface("blue shutters", {0.07f, 0.15f, 0.32f}),
                                            &surface("brown shutters", {0.24f, 0.11f, 0.05f})};
    MeshBuilder& paint = surface("white paint", {0.76f, 0.75f, 0.72f});
    MeshBuilder& pane = surface("panes", {0.06f, 0.075f, 0.09f});
    MeshBuilder& iron = surface("iron", {0.05f, 0.055f, 0.055f});
    MeshBuilder& wood = surface("wood", {0.3f, 0.17f, 0.08f});
    MeshBuilder& redCloth =
        surface("red awning", glm::vec3(1.0f),
                texture(makeStripeTexture("red stripes", {0.6f, 0.06f, 0.05f}, {0.75f, 0.7f, 0.62f})), 1.0f);
    MeshBuilder& blueCloth = surface(
        "blue awning", glm::vec3(1.0f),
        texture(makeStripeTexture("blue stripes", {0.08f, 0.2f, 0.45f}, {0.75f, 0.72f, 0.66f})), 1.0f);
    MeshBuilder& terracotta = surface("terracotta", {0.55f, 0.24f, 0.13f});
    MeshBuilder& leaf = surface("leaves", {0.13f, 0.3f, 0.06f});
    MeshBuilder& bark = surface("bark", {0.16f, 0.11f, 0.075f});
    MeshBuilder& meadow = surface("meadow", {0.2f, 0.28f, 0.09f});
    MeshBuilder& hills = surface("hills", {0.2f, 0.28f, 0.09f});
    MeshBuilder& forest = surface("forest", {0.07f, 0.15f, 0.06f});
    MeshBuilder& van = surface("enamel", {0.7f, 0.3f, 0.06f});
};

struct House {
    float begin; // along the street, from its mouth [m]
    float width; // [m]
    int storeys; // above the ground floor
    int wall, shutter;
    bool hasAwning;
};
constexpr float groundFloor = 3.3f, storeyHeight = 2.9f, depth = 8.0f;

// A house's own space: x along its front from 0 to its width, y up, z from its front outwards.
class HouseBuilder {
public:
    HouseBuilder(Street& s, const House& h, const glm::mat4& p) : street(s), house(h), place(p) {
        for (MeshBuilder* mesh : parts()) mesh->place(place);
    }
    ~HouseBuilder() {
        for (MeshBuilder* mesh : parts()) mesh->place(glm::mat4(1.0f));
    }
    HouseBuilder(const HouseBuilder&) = delete;
    HouseBuilder& operator=(const HouseBuilder&) = delete;

    void build() {
        const int columns = std::max(2, static_cast<int>(house.width / 2.3f));
        const float bay = house.width / static_cast<float>(columns);
        addGroundFloor(columns, bay);
        for (int storey = 0; storey < house.storeys; ++storey) {
            const float low = groundFloor + storeyHeight * static_cast<float>(storey);
            const float sill = low + 0.85f, lintel = low + 2.35f;
            wall().box({0, low, -depth}, {house.width, sill, 0});
            wall().box({0, lintel, -depth}, {house.width, low + storeyHeight, 0});
            for (int i = 0; i < columns; ++i) {
                const float middle = bay * (static_cast<float>(i) + 0.5f);
                addPier(bay * static_cast<float>(i), middle - 0.48f, sill, lintel);
                addPier(middle + 0.48f, bay * static_cast<float>(i + 1), sill, lintel);
                addWindow(middle, sill, lintel);
            }
        }
        addRoof();
    }

private:
    std::vector<MeshBuilder*> parts() const {
        return {&wall(),           &shutter(),   &street.roof,      &street.stone,
                &street.paint,     &street.pane, &street.wood,      &street.redCloth,
                &street.blueCloth, &street.iron, &street.terracotta};
    }
    MeshBuilder& wall() const { return *street.walls[static_cast<size_t>(house.wall)]; }
    MeshBuilder& shutter() const { return *street.shutters[static_cast<size_t>(house.shutter)]; }
    float eaves() const { return groundFloor + storeyHeight * static_cast<float>(house.storeys); }

    void addPier(float from, float to, float low, float high) {
        wall().box({from, low, -depth}, {to, high, 0});
    }

    // Panes behind a frame, in a reveal of 22 cm, with sill and open shutters.
    void addWindow(float middle, float low, float high) {
        constexpr float half = 0.48f, reveal = -0.22f;
        street.pane.box({middle - half, low, -depth}, {middle + half, high, reveal - 0.03f});
        for (const float x : {-half, -0.03f, half - 0.06f})
            street.paint.box({middle + x, low, reveal - 0.03f}, {middle + x + 0.06f, high, reveal + 0.02f});
        for (const float y : {low, low + 0.95f, high - 0.06f})
            street.paint.box({middle - half, y, reveal - 0.03f}, {middle + half, y + 0.05f, reveal + 0.015f});
        street.stone.box({middle - half - 0.1f, low - 0.09f, 0.0f}, {middle + half + 0.1f, low, 0.11f});
        for (const float side : {-1.0f, 1.0f}) {
            const float from = side < 0 ? middle - half - 0.47f : middle + half + 0.02f;
            shutter().box({from, low + 0.02f, 0.0f}, {from + 0.45f, high, 0.025f});
            for (int slat = 0; slat < 9; ++slat) {
                const float y = low + 0.1f + 0.155f * static_cast<float>(slat);
                shutter().box({from + 0.05f, y, 0.025f}, {from + 0.4f, y + 0.09f, 0.04f});
            }
        }
    }

    void addGroundFloor(int columns, float bay) {
        constexpr float lintel = 2.6f;
        wall().box({0, lintel, -depth}, {house.width, groundFloor, 0});
        street.stone.box({0.0f, groundFloor - 0.12f, 0.0f}, {house.width, groundFloor + 0.04f, 0.09f});
        for (int i = 0; i < columns; ++i) {
            const float middle = bay * (static_cast<float>(i) + 0.5f);
            const bool isDoor = i == columns / 2;
            const float half = isDoor ? 0.55f : 0.75f, low = isDoor ? 0.0f : 0.7f;
            addPier(bay * static_cast<float>(i), middle - half, 0.0f, lintel);
            addPier(middle + half, bay * static_cast<float>(i + 1), 0.0f, lintel);
            if (!isDoor) wall().box({middle - half, 0.0f, -depth}, {middle + half, low, 0.0f});
            MeshBuilder& filling = isDoor ? street.wood : street.pane;
            filling.box({middle - half, low, -depth}, {middle + half, lintel, -0.25f});
            for (const float x : {-half, half - 0.09f})
                street.stone.box({middle + x, low, -0.25f}, {middle + x + 0.09f, lintel, 0.03f});
            if (isDoor)
                street.stone.box({middle - half - 0.15f, 0.0f, 0.0f}, {middle + half + 0.15f, 0.15f, 0.35f});
            else
                street.stone.box({middle - half - 0.08f, low - 0.1f, 0.0f},
                                 {middle + half + 0.08f, low, 0.1f});
        }
        street.stone.box({0.0f, 0.0f, 0.0f}, {house.width, 0.45f, 0.05f});
        if (house.hasAwning) addAwning();
    }

    // Cloth on two arms over all of the front.
    void addAwning() {
        MeshBuilder& cloth = house.wall % 2 == 0 ? street.redCloth : street.blueCloth;
        const float from = 0.3f, to = house.width - 0.3f;
        constexpr float half = 0.012f; // of the cloth's thickness
        const std::array<glm::vec3, 4> upper = {glm::vec3(from, 2.45f + half, 1.35f),
                                                {to, 2.45f + half, 1.35f},
                                                {to, 3.0f + half, 0.02f},
                                                {from, 3.0f + half, 0.02f}};
        const std::array<glm::vec3, 4> lower = {glm::vec3(from, 3.0f - half, 0.02f),
                                                {to, 3.0f - half, 0.02f},
                                                {to, 2.45f - half, 1.35f},
                                                {from, 2.45f - half, 1.35f}};
        cloth.face(upper);
        cloth.face(lower);
        for (size_t i = 0; i < 4; ++i) { // from the upper side's edges to the lower side's
            const size_t next = (i + 1) % 4;
            const std::array<size_t, 4> below = {3, 2, 1, 0};
            const std::array<glm::vec3, 4> edge = {lower[below[i]], lower[below[next]], upper[next],
                                                   upper[i]};
            cloth.face(edge);
        }
        for (const float x : {from + 0.1f, to - 0.1f})
            street.iron.rod({x, 2.2f, 0.0f}, {x, 2.43f, 1.3f}, 0.018f, 8);
    }

    // A gable roof whose ridge runs along the front, over a cornice; a chimney.
    void addRoof() {
        const float low = eaves(), high = low + 2.3f;
        street.stone.box({0.0f, low, -depth}, {house.width, low + 0.22f, 0.28f});
        const std::array<glm::vec2, 3> gable = {
            glm::vec2(0.45f, low + 0.22f), {-depth / 2, high}, {-depth - 0.2f, low + 0.22f}};
        std::array<glm::vec3, 3> left, right;
        for (size_t i = 0; i < 3; ++i) {
            left[i] = {0.0f, gable[i].y, gable[i].x};
            right[2 - i] = {house.width, gable[i].y, gable[i].x};
        }
        street.roof.face(right);
        street.roof.face(left);
        for (size_t i = 0; i < 3; ++i) {
            const glm::vec2 p = gable[i], q = gable[(i + 1) % 3];
            const std::array<glm::vec3, 4> slope = {
                glm::vec3(0, p.y, p.x), {house.width, p.y, p.x}, {house.width, q.y, q.x}, {0, q.y, q.x}};
            street.roof.face(slope);
        }
        const float chimney = house.width * 0.7f;
        wall().box({chimney, high - 1.2f, -depth / 2 + 0.6f},
                   {chimney + 0.6f, high + 0.7f, -depth / 2 + 1.2f});
        street.terracotta.rod({chimney + 0.3f, high + 0.7f, -depth / 2 + 0.9f},
                              {chimney + 0.3f, high + 1.1f, -depth / 2 + 0.9f}, 0.13f, 12);
    }

    Street& street;
    const House& house;
    glm::mat4 place;
};

void addHouses(Street& s) {
    constexpr std::array<House, 7> left = {House{-9.0f, 8.0f, 2, 2, 0, false}, {-1.0f, 7.0f, 1, 0, 1, true},
                                           {6.0f, 5.2f, 3, 1, 0, false},       {11.2f, 8.4f, 2, 4, 2, true},
                                           {19.6f, 6.0f, 2, 0, 0, false},      {25.6f, 7.6f, 3, 2, 1, false},
                                           {33.2f, 6.4f, 1, 1, 2, true}};
    constexpr std::array<House, 6> right = {
        House{-8.0f, 9.4f, 2, 0, 2, false}, {1.4f, 6.2f, 3, 3, 0, true},   {7.6f, 7.8f, 1, 1, 1, false},
        {15.4f, 6.2f, 2, 2, 0, true},       {21.6f, 8.2f, 3, 4, 2, false}, {29.8f, 9.0f, 2, 0, 1, false}};
    for (const House& house : left)
        HouseBuilder(s, house, placedAt({-front, pavement, -house.begin}, 90.0f)).build();
    for (const House& house : right)
        HouseBuilder(s, house, placedAt({front, pavement, -house.begin - house.width}, -90.0f)).build();
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
        HouseBuilder(s, {0, 12.5f, 1 + i % 3, i, i % 3, false}, placedAt({x, 0.0f, -104.0f}, 0.0f)).build();
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
