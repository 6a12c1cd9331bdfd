// SPDX-License-Identifier: MIT
// Light that a surface reflects, by sampling lights and by following the surface's own directions, each
// weighted by the density of both where both can find it (Veach's balance heuristic): free of outliers near
// lights and far.
#pragma once

#include "lab/light/emissive_surfaces.hpp"
#include "lab/light/sampling.hpp"
#include "lab/light/surface_lobes.hpp"
#include "lab/rays/embree_scene.hpp"

namespace rebound::lab {

// A place where light is reflected.
struct Reflector {
    SurfacePoint point;
    glm::vec3 toViewer{0.0f}; // unit
    SurfaceLobes lobes;
};

// What a direction that the lobes were sampled for meets.
struct Arrival {
    glm::vec3 light{0.0f}; // radiance that came this way straight from emitters, weighted [W m^-2 sr^-1]
    std::optional<LocationHit> hit;
};

class LightSampling {
public:
    // The scene has to outlive this.
    explicit LightSampling(const EmbreeScene&);

    // Radiance that the lobes reflect of directional, point and spot lights: exact [W m^-2 sr^-1].
    glm::vec3 fromPoints(const Reflector&) const;

    // The same of area lights and emissive surfaces, estimated by one place on each light and one on all
    // surfaces.
    glm::vec3 fromSurfaces(const Reflector&, SampleSequence&) const;

    // What a surface emits, where that is no direct light: radiance like that which it reflects [W m^-2 sr^-1].
    glm::vec3 sentEmission(const SurfacePoint& point) const {
        return scene->scene().emissiveMaterialsLight ? glm::vec3(0.0f) : point.emission;
    }

    // Follows a direction that was sampled with that density per solid angle.
    Arrival follow(const SurfacePoint&, glm::vec3 direction, float density) const;

    // Whether fromSurfaces() and follow() can find light: if not, fromPoints() is all there is.
    bool hasExtendedLight() const { return anyExtended; }

private:
    glm::vec3 fromPoint(const Reflector&, const Light&) const;
    glm::vec3 fromArea(const Reflector&, const Light&, glm::vec2 square) const;
    glm::vec3 fromEmissive(const Reflector&, glm::vec2 square) const;
    glm::vec3 areasAlong(const Ray&, float hitDistance, float density) const;
    glm::vec3 emitted(const LocationHit&, glm::vec3 direction, float density) const;

    const EmbreeScene* scene;
    EmissiveSurfaces emissive;
    bool anyExtended = false;
};

} // namespace rebound::lab
