// SPDX-License-Identifier: MIT
// What the street is built of.
#pragma once

#include "lab/scenes/builtin_textures.hpp"
#include "lab/scenes/scene_builder.hpp"

#include <array>

namespace rebound::lab {

// The street runs along -z; its houses' fronts stand at x = -front and front [m].
inline constexpr float front = 4.6f, kerb = 2.9f, pavement = 0.14f;

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

// place: from the house's space, whose front is its z = 0, to the world.
void addHouse(Street&, const House&, const glm::mat4& place);

} // namespace rebound::lab
