// SPDX-License-Identifier: MIT
#include "lab/direct_light.hpp"

#include "lab/low_discrepancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rebound::lab {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Cosine of a unit direction with the shading normal; 0 for light that falls on the other side of the
// surface.
float receivedCosine(const SurfacePoint& point, glm::vec3 direction) {
    if (!(glm::dot(point.geometricNormal, direction) > 0.0f))
        return 0.0f;
    return std::max(0.0f, glm::dot(point.shadingNormal, direction));
}

// The edge of KHR_lights_punctual: the square of a ramp in the cosine, from 0 at the outer cone to 1 at the
// inner.
float spotAttenuation(const Light& light, glm::vec3 towardsLight) {
    const float cosine = glm::dot(-towardsLight, light.direction);
    const float outer = std::cos(light.outerCone);
    const float inner = std::cos(light.innerCone);
    if (cosine < outer)
        return 0.0f;
    if (cosine >= inner || inner <= outer)
        return 1.0f;
    const float ramp = (cosine - outer) / (inner - outer);
    return ramp * ramp;
}

// Directions about a unit normal with density cosine / pi. Duff et al.: Building an Orthonormal Basis,
// Revisited.
glm::vec3 cosineDirection(glm::vec3 n, glm::vec2 square) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    const glm::vec3 tangent(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const glm::vec3 bitangent(b, sign + n.y * n.y * a, -n.y);
    const float radius = std::sqrt(square.x);
    const float angle = 2.0f * pi * square.y;
    return tangent * (radius * std::cos(angle)) + bitangent * (radius * std::sin(angle)) +
           n * std::sqrt(std::max(0.0f, 1.0f - square.x));
}

// A shadow ray towards an area light ends this far before it, as other surfaces may lie in its plane.
float clearanceOf(const Light& light) {
    const glm::vec3 position = glm::abs(light.position);
    const float largest = std::max({position.x, position.y, position.z, light.size.x, light.size.y});
    return 4.0f * std::numeric_limits<float>::epsilon() * largest;
}

} // namespace

DirectLight::DirectLight(const EmbreeScene& embreeScene, int sampleCount)
    : scene(&embreeScene), emissive(embreeScene), samples(sampleCount) {}

glm::vec3 DirectLight::irradiance(const SurfacePoint& point, uint32_t seed) const {
    glm::vec3 sum(0.0f);
    uint32_t stream = 0;
    for (const Light& light : scene->scene().lights)
        sum += fromLight(point, light, hashBits(seed, stream++));
    if (!emissive.empty())
        sum += fromEmissiveSurfaces(point, hashBits(seed, stream++));
    if (!emissive.empty() || scene->scene().environment != glm::vec3(0.0f))
        sum += fromHemisphere(point, hashBits(seed, stream));
    return sum;
}

glm::vec3 DirectLight::fromLight(const SurfacePoint& point, const Light& light, uint32_t seed) const {
    switch (light.type) {
    case LightType::directional:
        return fromDirectional(point, light);
    case LightType::point:
    case LightType::spot:
        return fromPointOrSpot(point, light);
    case LightType::area:
        return fromArea(point, light, seed);
    }
    return glm::vec3(0.0f);
}

glm::vec3 DirectLight::fromDirectional(const SurfacePoint& point, const Light& light) const {
    const float cosine = receivedCosine(point, -light.direction);
    if (cosine == 0.0f || !scene->open(point, -light.direction))
        return glm::vec3(0.0f);
    return light.intensity * cosine;
}

glm::vec3 DirectLight::fromPointOrSpot(const SurfacePoint& point, const Light& light) const {
    const glm::vec3 towards = light.position - point.position;
    const float distance = glm::length(towards);
    if (!(distance > 0.0f))
        return glm::vec3(0.0f);
    const glm::vec3 direction = towards / distance;
    float factor = receivedCosine(point, direction);
    if (light.type == LightType::spot)
        factor *= spotAttenuation(light, direction);
    if (factor == 0.0f || !scene->visible(point, light.position))
        return glm::vec3(0.0f);
    return light.intensity * (factor / distance / distance);
}

glm::vec3 DirectLight::fromArea(const SurfacePoint& point, const Light& light, uint32_t seed) const {
    const glm::vec3 halfRight = light.right * (0.5f * light.size.x);
    const glm::vec3 halfUp = glm::cross(light.direction, light.right) * (0.5f * light.size.y);
    const float clearance = clearanceOf(light);
    float sum = 0.0f;
    for (int i = 0; i < samples; ++i) {
        const glm::vec2 square = 2.0f * sobolPoint(uint32_t(i), seed) - 1.0f;
        const glm::vec3 target = light.position + halfRight * square.x + halfUp * square.y;
        const glm::vec3 towards = target - point.position;
        const float distance = glm::length(towards);
        if (!(distance > 0.0f))
            continue;
        const glm::vec3 direction = towards / distance;
        const float emitted = std::max(0.0f, -glm::dot(direction, light.direction));
        const float cosines = receivedCosine(point, direction) * emitted;
        const glm::vec3 end = target + light.direction * (clearance + endClearance(distance));
        if (cosines > 0.0f && scene->visible(point, end))
            sum += cosines / distance / distance;
    }
    return light.intensity * (sum * light.size.x * light.size.y / float(samples));
}

// What a hemisphere ray that met an emissive triangle adds; density is that of sampling the place, per area.
glm::vec3 DirectLight::arriving(const LocationHit& hit, glm::vec3 direction, float density,
                                float cosine) const {
    const SurfacePoint emitter = scene->surfaceAt(hit.location, direction);
    const float emitted = -glm::dot(direction, emitter.geometricNormal);
    if (!(emitted > 0.0f))
        return glm::vec3(0.0f);
    const float perSolidAngle = density * hit.distance * hit.distance / emitted;
    return emitter.emission * (cosine / (perSolidAngle + cosine / pi));
}

// In both estimators a sample counts radiance * cosine / (sum of their densities): the balance heuristic's
// weight cancels the density of the one that drew it.
glm::vec3 DirectLight::fromEmissiveSurfaces(const SurfacePoint& point, uint32_t seed) const {
    glm::vec3 sum(0.0f);
    for (int i = 0; i < samples; ++i) {
        const SurfaceLocation at = emissive.sample(sobolPoint(uint32_t(i), seed));
        const glm::vec3 towards = scene->positionAt(at) - point.position;
        const float distance = glm::length(towards);
        if (!(distance > 0.0f) || scene->isHole(at))
            continue;
        const glm::vec3 direction = towards / distance;
        const float cosine = receivedCosine(point, direction);
        if (cosine == 0.0f)
            continue;
        const SurfacePoint emitter = scene->surfaceAt(at, direction);
        const float emitted = -glm::dot(direction, emitter.geometricNormal);
        if (!(emitted > 0.0f) || emitter.emission == glm::vec3(0.0f))
            continue;
        const float density = emissive.density(at) * distance * distance / emitted;
        if (scene->visible(point, emitter))
            sum += emitter.emission * (cosine / (density + cosine / pi));
    }
    return sum / float(samples);
}

glm::vec3 DirectLight::fromHemisphere(const SurfacePoint& point, uint32_t seed) const {
    const glm::vec3 environment = scene->scene().environment;
    const glm::vec3 origin = point.position + point.geometricNormal * point.clearance;
    glm::vec3 sum(0.0f);
    for (int i = 0; i < samples; ++i) {
        const glm::vec3 direction = cosineDirection(point.shadingNormal, sobolPoint(uint32_t(i), seed));
        const float cosine = receivedCosine(point, direction);
        if (cosine == 0.0f)
            continue;
        if (emissive.empty()) {
            if (scene->open(point, direction))
                sum += pi * environment;
            continue;
        }
        const auto hit = scene->locate({origin, direction});
        if (!hit)
            sum += pi * environment;
        else if (const float density = emissive.density(hit->location); density > 0.0f)
            sum += arriving(*hit, direction, density, cosine);
    }
    return sum / float(samples);
}

} // namespace rebound::lab
