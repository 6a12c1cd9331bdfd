// SPDX-License-Identifier: MIT
// What moves in the engines when they show a baked scene: a ball that the bake does not know, and lights.
#pragma once

#include "lights.hpp"
#include "rebound/techniques/surfel_light.hpp"

namespace rebound::engine {

// The name of the mesh that SceneData::Part::moves marks.
inline constexpr const char* movingMesh = "moving ball";

// A ball between the first camera and its target, around the origin: Moment::offset says where it is.
void addBall(lab::Scene&);

struct Moment {
    glm::vec3 offset{0.0f}; // of the moving mesh [m]
    LightSetup lights;
};

// Of a frame: the ball swings before the scene's first camera, the light that casts shadows swings too, and all other
// lights are on for 40 frames and off for 40.
Moment momentOf(const lab::Scene&, int frame);

// The same lights for surfels, by the same shadow map, which is map 0.
struct SurfelSources {
    std::vector<LightSource> sources;
    ShadowView view{};
};
inline constexpr int maximumSurfelSources = 256;

SurfelSources surfelSourcesOf(const LightSetup&);

} // namespace rebound::engine
