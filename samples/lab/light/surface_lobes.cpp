// SPDX-License-Identifier: MIT
#include "lab/light/surface_lobes.hpp"

#include "lab/images/luminance.hpp"
#include "lab/light/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rebound::lab {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float dielectricReflectance = 0.04f; // of glTF 2.0: a refractive index of 1.5
constexpr float smallestAlpha =
    1e-3f; // a mirror within half a milliradian; narrower lobes leave float's range

float squared(float x) { return x * x; }

float exponentOf(float alpha) { return 2.0f / squared(alpha) - 2.0f; }

// Powers of cosines near 1, where std::pow in single precision would lose the small difference.
float powerOfCosine(float cosine, float exponent) {
    return cosine > 0.0f ? float(std::pow(double(cosine), double(exponent))) : 0.0f;
}

glm::vec3 fresnel(glm::vec3 normalReflectance, float cosine) {
    return normalReflectance +
           (1.0f - normalReflectance) * std::pow(std::clamp(1.0f - cosine, 0.0f, 1.0f), 5.0f);
}

glm::vec3 mirrored(glm::vec3 n, glm::vec3 direction) { return 2.0f * glm::dot(n, direction) * n - direction; }

// Density of half vectors, per solid angle, times their cosine: what they cover of the surface.
float distribution(const SpecularLobe& lobe, float cosine) {
    if (lobe.model == GlossyModel::blinnPhong) {
        const float exponent = exponentOf(lobe.alpha);
        return (exponent + 2.0f) / (2.0f * pi) * powerOfCosine(cosine, exponent);
    }
    const double alpha2 = double(lobe.alpha) * double(lobe.alpha);
    const double t = double(cosine) * double(cosine) * (alpha2 - 1.0) + 1.0;
    return float(alpha2 / (std::numbers::pi * t * t));
}

// Smith's function of one direction.
float smithLambda(float alpha, float cosine) {
    const float tangent2 = std::max(0.0f, 1.0f / squared(cosine) - 1.0f);
    return 0.5f * (std::sqrt(1.0f + squared(alpha) * tangent2) - 1.0f);
}

// The share of microfacets that both sides see: height-correlated Smith for GGX, V-cavities for Blinn-Phong.
float shadowing(const SpecularLobe& lobe, float viewer, float light, float half, float halfViewer) {
    if (lobe.model == GlossyModel::ggx)
        return 1.0f / (1.0f + smithLambda(lobe.alpha, viewer) + smithLambda(lobe.alpha, light));
    return std::min(1.0f, 2.0f * half * std::min(viewer, light) / halfViewer);
}

// Half vectors that a viewer sees, in tangent space. Heitz: Sampling the GGX Distribution of Visible Normals.
glm::vec3 visibleHalf(float alpha, glm::vec3 viewer, glm::vec2 square) {
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * viewer.x, alpha * viewer.y, viewer.z));
    const float length2 = squared(stretched.x) + squared(stretched.y);
    const glm::vec3 first =
        length2 > 0.0f ? glm::vec3(-stretched.y, stretched.x, 0.0f) / std::sqrt(length2) : glm::vec3(1, 0, 0);
    const glm::vec3 second = glm::cross(stretched, first);
    const float radius = std::sqrt(square.x);
    const float angle = 2.0f * pi * square.y;
    const float a = radius * std::cos(angle);
    const float share = 0.5f * (1.0f + stretched.z);
    const float b =
        (1.0f - share) * std::sqrt(std::max(0.0f, 1.0f - squared(a))) + share * radius * std::sin(angle);
    const glm::vec3 half =
        a * first + b * second + std::sqrt(std::max(0.0f, 1.0f - squared(a) - squared(b))) * stretched;
    return glm::normalize(glm::vec3(alpha * half.x, alpha * half.y, std::max(1e-6f, half.z)));
}

// About the z axis with density proportional to the cosine's power.
glm::vec3 powerDirection(float exponentPlusOne, glm::vec2 square) {
    const float cosine = float(std::pow(double(1.0f - square.x), 1.0 / double(exponentPlusOne)));
    const float sine = std::sqrt(std::max(0.0f, 1.0f - squared(cosine)));
    const float angle = 2.0f * pi * square.y;
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

SpecularLobe specularLobeOf(const Material& material, glm::vec3 albedo, GlossyModel model) {
    SpecularLobe lobe;
    lobe.model = model;
    if (model == GlossyModel::diffuseOnly) return lobe;
    lobe.normalReflectance = glm::mix(glm::vec3(dielectricReflectance), albedo, material.metallic);
    lobe.alpha = std::clamp(squared(material.roughness), smallestAlpha, 1.0f);
    return lobe;
}

} // namespace

glm::vec3 SpecularLobe::value(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const {
    const float cosineViewer = glm::dot(n, viewer);
    const float cosineLight = glm::dot(n, light);
    if (model == GlossyModel::diffuseOnly || !(cosineViewer > 0.0f && cosineLight > 0.0f))
        return glm::vec3(0.0f);
    const glm::vec3 half = glm::normalize(viewer + light);
    const float halfViewer = glm::dot(half, viewer);
    const glm::vec3 reflectance = fresnel(normalReflectance, halfViewer);
    if (model == GlossyModel::phong) {
        const float exponent = exponentOf(alpha);
        return reflectance * ((exponent + 1.0f) / (2.0f * pi * std::max(cosineViewer, cosineLight)) *
                              powerOfCosine(glm::dot(mirrored(n, viewer), light), exponent));
    }
    const float cosineHalf = glm::dot(n, half);
    return reflectance * (distribution(*this, cosineHalf) *
                          shadowing(*this, cosineViewer, cosineLight, cosineHalf, halfViewer) /
                          (4.0f * cosineViewer * cosineLight));
}

float SpecularLobe::density(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const {
    const float cosineViewer = glm::dot(n, viewer);
    if (model == GlossyModel::diffuseOnly || !(cosineViewer > 0.0f)) return 0.0f;
    if (model == GlossyModel::phong) {
        const float exponent = exponentOf(alpha);
        return (exponent + 1.0f) / (2.0f * pi) *
               powerOfCosine(glm::dot(mirrored(n, viewer), light), exponent);
    }
    const glm::vec3 sum = viewer + light;
    const float length = glm::length(sum);
    if (!(length > 0.0f) || !(glm::dot(n, sum) > 0.0f)) return 0.0f;
    const glm::vec3 half = sum / length;
    const float cosineHalf = glm::dot(n, half);
    if (model == GlossyModel::blinnPhong)
        return distribution(*this, cosineHalf) * cosineHalf / (4.0f * glm::dot(half, viewer));
    return distribution(*this, cosineHalf) /
           (4.0f * cosineViewer * (1.0f + smithLambda(alpha, cosineViewer)));
}

glm::vec3 SpecularLobe::sample(glm::vec3 n, glm::vec3 viewer, glm::vec2 square) const {
    if (model == GlossyModel::phong)
        return fromTangentSpace(mirrored(n, viewer), powerDirection(exponentOf(alpha) + 1.0f, square));
    const glm::vec3 half = model == GlossyModel::blinnPhong
                               ? powerDirection(exponentOf(alpha) + 2.0f, square)
                               : visibleHalf(alpha, toTangentSpace(n, viewer), square);
    return mirrored(fromTangentSpace(n, half), viewer);
}

glm::vec3 SurfaceLobes::value(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const {
    return diffuse / pi + specular.value(n, viewer, light);
}

float SurfaceLobes::density(glm::vec3 n, glm::vec3 viewer, glm::vec3 light) const {
    const float cosine = std::max(0.0f, glm::dot(n, light)) / pi;
    if (specularShare == 0.0f) return cosine;
    return (1.0f - specularShare) * cosine + specularShare * specular.density(n, viewer, light);
}

glm::vec3 SurfaceLobes::sample(glm::vec3 n, glm::vec3 viewer, glm::vec2 square, float choice) const {
    return choice < specularShare ? specular.sample(n, viewer, square) : cosineDirection(n, square);
}

SurfaceLobes whiteDiffuse() {
    SurfaceLobes lobes;
    lobes.diffuse = glm::vec3(1.0f);
    return lobes;
}

SurfaceLobes lobesOf(const Material& material, glm::vec3 albedo, GlossyModel model) {
    SurfaceLobes lobes;
    lobes.diffuse = diffuseReflectance(material, albedo, model);
    lobes.specular = specularLobeOf(material, albedo, model);
    const float specular = luminance(lobes.specular.normalReflectance);
    const float sum = specular + luminance(lobes.diffuse);
    lobes.specularShare = sum > 0.0f ? specular / sum : 0.0f;
    return lobes;
}

SurfaceLobes specularOf(const Material& material, glm::vec3 albedo, GlossyModel model) {
    SurfaceLobes lobes;
    lobes.specular = specularLobeOf(material, albedo, model);
    lobes.specularShare = 1.0f;
    return lobes;
}

glm::vec3 diffuseReflectance(const Material& material, glm::vec3 albedo, GlossyModel model) {
    return model == GlossyModel::diffuseOnly
               ? albedo
               : albedo * ((1.0f - material.metallic) * (1.0f - dielectricReflectance));
}

} // namespace rebound::lab
