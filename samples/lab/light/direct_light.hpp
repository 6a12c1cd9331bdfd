// SPDX-License-Identifier: MIT
// Irradiance straight from the lights, the emissive surfaces and the environment of a scene.
#pragma once

#include "lab/light/light_sampling.hpp"

namespace rebound::lab {

class DirectLight {
public:
    // samples: how often a call to irradiance() samples each area light, all emissive surfaces, and the
    // hemisphere where the scene has any of these or an environment; at least 1. The scene has to outlive
    // this.
    DirectLight(const EmbreeScene&, int samples);

    // On the side of the shading normal [W m^-2]. Equal seeds give equal values; different seeds, independent
    // ones.
    glm::vec3 irradiance(const SurfacePoint&, uint32_t seed) const;

private:
    const EmbreeScene* scene;
    LightSampling light;
    int samples;
};

} // namespace rebound::lab
