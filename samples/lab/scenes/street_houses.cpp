// SPDX-License-Identifier: MIT
#include "lab/scenes/street_parts.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rebound::lab {
namespace {

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

} // namespace

void addHouse(Street& street, const House& house, const glm::mat4& place) {
    HouseBuilder(street, house, place).build();
}

} // namespace rebound::lab
