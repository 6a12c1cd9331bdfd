// SPDX-License-Identifier: MIT
// A scene's lights as the light pass takes them.
#pragma once

#include "lab/scenes/scene.hpp"

namespace rebound::engine {

// Its twin is in shaders/light.glsl, where the fields are explained.
struct GpuLight {
    glm::vec4 position, direction, intensity;
};

// One light casts shadows: the first directional one, else the first spot light, else the first area light, from its
// centre. Area lights are 16 discs each, and all emissive triangles together 64, chosen by power. The environment sends
// nothing: a renderer that knows no occlusion would let it shine into closed rooms.
struct LightSetup {
    std::vector<GpuLight> lights; // the shadowed ones first; never empty
    int shadowed = 0;
    int count = 0;
    glm::mat4 shadowMatrix{1.0f}; // world to clip space, depth 0 near to 1 far
    float shadowTexel = 0.0f;     // a texel's side: at unit distance [1] in perspective, else anywhere [m]
    bool shadowPerspective = false;
    bool emissionIsDirectLight =
        true; // emissive surfaces are among the lights, so that they send nothing to be gathered
};
inline constexpr int shadowMapSize = 2048; // [texels]

LightSetup lightsOf(const lab::Scene&);
// With other lights than the scene's.
LightSetup lightsOf(const lab::Scene&, const std::vector<lab::Light>&);

// The light that casts shadows, or null.
const lab::Light* shadowCaster(const std::vector<lab::Light>&);

} // namespace rebound::engine
