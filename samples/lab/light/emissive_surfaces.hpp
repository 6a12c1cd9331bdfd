// SPDX-License-Identifier: MIT
// Points on the emissive triangles of a scene, chosen about in proportion to the power they emit.
#pragma once

#include "lab/rays/embree_scene.hpp"

#include <vector>

namespace rebound::lab {

class EmissiveSurfaces {
public:
    // Empty where the scene's emissive materials give no light.
    explicit EmissiveSurfaces(const EmbreeScene&);

    bool empty() const { return triangles.empty(); }

    // Maps a point of the unit square to a place on an emissive triangle. Precondition: not empty.
    SurfaceLocation sample(glm::vec2 square) const;

    // Probability density of sample() per area at any location on a triangle [m^-2]; 0 where it never leads.
    float density(const SurfaceLocation&) const;

private:
    struct Triangle {
        uint32_t mesh;
        uint32_t triangle;
        double cumulative; // share of all triangles up to and with this one
        float density;
    };

    const Triangle* find(const SurfaceLocation&) const;

    std::vector<Triangle> triangles; // by mesh and triangle
};

} // namespace rebound::lab
