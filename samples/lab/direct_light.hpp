// SPDX-License-Identifier: MIT
// Irradiance straight from the lights, the emissive surfaces and the environment of a scene.
#pragma once

#include "lab/embree_scene.hpp"
#include "lab/emissive_surfaces.hpp"

namespace rebound::lab {

class DirectLight {
public:
    // samples: rays a call to irradiance() casts for each area light, towards all emissive surfaces, and into
    // the hemisphere where the scene has an environment or emissive surfaces; at least 1. The scene has to
    // outlive this.
    DirectLight(const EmbreeScene&, int samples);

    // On the side of the shading normal [W m^-2]. Equal seeds give equal values; different seeds, independent
    // ones. Emissive surfaces are estimated by both kinds of rays, weighted by their densities, so that they
    // stay free of outliers near and far (Veach's balance heuristic).
    glm::vec3 irradiance(const SurfacePoint&, uint32_t seed) const;

private:
    glm::vec3 fromLight(const SurfacePoint&, const Light&, uint32_t seed) const;
    glm::vec3 fromDirectional(const SurfacePoint&, const Light&) const;
    glm::vec3 fromPointOrSpot(const SurfacePoint&, const Light&) const;
    glm::vec3 fromArea(const SurfacePoint&, const Light&, uint32_t seed) const;
    glm::vec3 fromEmissiveSurfaces(const SurfacePoint&, uint32_t seed) const;
    glm::vec3 fromHemisphere(const SurfacePoint&, uint32_t seed) const;
    glm::vec3 arriving(const LocationHit&, glm::vec3 direction, float density, float cosine) const;

    const EmbreeScene* scene;
    EmissiveSurfaces emissive;
    int samples;
};

} // namespace rebound::lab
