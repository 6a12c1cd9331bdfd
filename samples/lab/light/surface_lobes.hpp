// SPDX-License-Identifier: MIT
// How a surface reflects: a diffuse and a specular lobe, each with what sampling it takes.
#pragma once

#include "lab/light/path_tracer.hpp"

namespace rebound::lab {

// All directions are of unit length and point away from the surface; n is the shading normal. What lies below
// it gives 0.
struct SpecularLobe {
    GlossyModel model = GlossyModel::diffuseOnly;
    glm::vec3 normalReflectance{0.0f}; // at normal incidence, 0 to 1
    float alpha = 1.0f;                // width, of microfacets' slopes

    // The BRDF [sr^-1].
    glm::vec3 value(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const;
    // Of sample(), per solid angle [sr^-1].
    float density(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const;
    // May lie below the surface, where value() is 0.
    glm::vec3 sample(glm::vec3 n, glm::vec3 viewer, glm::vec2 square) const;
};

struct SurfaceLobes {
    glm::vec3 diffuse{0.0f}; // reflectance, 0 to 1
    SpecularLobe specular;
    float specularShare = 0.0f; // of the samples that follow the specular lobe, 0 to 1

    glm::vec3 value(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const;
    float density(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const;
    glm::vec3 sample(glm::vec3 n, glm::vec3 viewer, glm::vec2 square, float choice) const;
};

// Reflectance 1 and nothing else: light that it reflects is irradiance over pi.
SurfaceLobes whiteDiffuse();

// The diffuse part of a material whose base colour at the point is `albedo`.
glm::vec3 diffuseReflectance(const Material&, glm::vec3 albedo, GlossyModel);

// Of a material whose base colour at the point is `albedo`.
SurfaceLobes lobesOf(const Material&, glm::vec3 albedo, GlossyModel);
// Without the diffuse lobe.
SurfaceLobes specularOf(const Material&, glm::vec3 albedo, GlossyModel);

} // namespace rebound::lab
