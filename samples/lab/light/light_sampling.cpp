// SPDX-License-Identifier: MIT
#include "lab/light/light_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rebound::lab {

namespace {

// The edge of KHR_lights_punctual: the square of a ramp in the cosine, from 0 at the outer cone to 1 at the
// inner.
float spotAttenuation(const Light& light, glm::vec3 towardsLight) {
    const float cosine = glm::dot(-towardsLight, light.direction);
    const float outer = std::cos(light.outerCone);
    const float inner = std::cos(light.innerCone);
    if (cosine < outer) return 0.0f;
    if (cosine >= inner || inner <= outer) return 1.0f;
    const float ramp = (cosine - outer) / (inner - outer);
    return ramp * ramp;
}

// A shadow ray towards an area light ends this far before it, as other surfaces may lie in its plane.
float clearanceOf(const Light& light) {
    const glm::vec3 position = glm::abs(light.position);
    const float largest = std::max({position.x, position.y, position.z, light.size.x, light.size.y});
    return 4.0f * std::numeric_limits<float>::epsilon() * largest;
}

glm::vec3 upOf(const Light& area) { return glm::cross(area.direction, area.right); }

// Density of uniform places on an area light, per solid angle.
float areaDensity(const Light& light, float distance, float emittedCosine) {
    return distance * distance / (emittedCosine * light.size.x * light.size.y);
}

// Of light that arrives from a direction [sr^-1].
glm::vec3 reflectance(const Reflector& reflector, glm::vec3 direction, float cosine) {
    return reflector.lobes.value(reflector.point.shadingNormal, reflector.toViewer, direction) * cosine;
}

float densityOf(const Reflector& reflector, glm::vec3 direction) {
    return reflector.lobes.density(reflector.point.shadingNormal, reflector.toViewer, direction);
}

} // namespace

LightSampling::LightSampling(const EmbreeScene& embreeScene) : scene(&embreeScene), emissive(embreeScene) {
    const Scene& source = embreeScene.scene();
    anyExtended = !emissive.empty() || source.environment != glm::vec3(0.0f) ||
                  std::any_of(source.lights.begin(), source.lights.end(),
                              [](const Light& light) { return light.type == LightType::area; });
}

glm::vec3 LightSampling::fromPoints(const Reflector& reflector) const {
    glm::vec3 sum(0.0f);
    for (const Light& light : scene->scene().lights)
        if (light.type != LightType::area) sum += fromPoint(reflector, light);
    return sum;
}

glm::vec3 LightSampling::fromPoint(const Reflector& reflector, const Light& light) const {
    const SurfacePoint& point = reflector.point;
    if (light.type == LightType::directional) {
        const float cosine = receivedCosine(point, -light.direction);
        if (cosine == 0.0f || !scene->open(point, -light.direction)) return glm::vec3(0.0f);
        return light.intensity * reflectance(reflector, -light.direction, cosine);
    }
    const glm::vec3 towards = light.position - point.position;
    const float distance = glm::length(towards);
    if (!(distance > 0.0f)) return glm::vec3(0.0f);
    const glm::vec3 direction = towards / distance;
    float factor = receivedCosine(point, direction);
    if (light.type == LightType::spot) factor *= spotAttenuation(light, direction);
    if (factor == 0.0f || !scene->visible(point, light.position)) return glm::vec3(0.0f);
    return light.intensity * reflectance(reflector, direction, factor / distance / distance);
}

glm::vec3 LightSampling::fromSurfaces(const Reflector& reflector, SampleSequence& sequence) const {
    glm::vec3 sum(0.0f);
    for (const Light& light : scene->scene().lights)
        if (light.type == LightType::area) sum += fromArea(reflector, light, sequence.next());
    if (!emissive.empty()) sum += fromEmissive(reflector, sequence.next());
    return sum;
}

// In both estimators a sample counts radiance * reflectance / (sum of their densities): the balance
// heuristic's weight cancels the density of the one that drew it.
glm::vec3 LightSampling::fromArea(const Reflector& reflector, const Light& light, glm::vec2 square) const {
    const glm::vec2 place = light.size * (square - 0.5f);
    const glm::vec3 target = light.position + light.right * place.x + upOf(light) * place.y;
    const glm::vec3 towards = target - reflector.point.position;
    const float distance = glm::length(towards);
    if (!(distance > 0.0f)) return glm::vec3(0.0f);
    const glm::vec3 direction = towards / distance;
    const float emittedCosine = -glm::dot(direction, light.direction);
    const float cosine = receivedCosine(reflector.point, direction);
    if (!(emittedCosine > 0.0f) || cosine == 0.0f) return glm::vec3(0.0f);
    const glm::vec3 end = target + light.direction * (clearanceOf(light) + endClearance(distance));
    if (!scene->visible(reflector.point, end)) return glm::vec3(0.0f);
    const float densities = areaDensity(light, distance, emittedCosine) + densityOf(reflector, direction);
    return light.intensity * (reflectance(reflector, direction, cosine) / densities);
}

glm::vec3 LightSampling::fromEmissive(const Reflector& reflector, glm::vec2 square) const {
    const SurfaceLocation at = emissive.sample(square);
    const glm::vec3 towards = scene->positionAt(at) - reflector.point.position;
    const float distance = glm::length(towards);
    if (!(distance > 0.0f) || scene->isHole(at)) return glm::vec3(0.0f);
    const glm::vec3 direction = towards / distance;
    const float cosine = receivedCosine(reflector.point, direction);
    if (cosine == 0.0f) return glm::vec3(0.0f);
    const SurfacePoint emitter = scene->surfaceAt(at, direction);
    const float emittedCosine = -glm::dot(direction, emitter.geometricNormal);
    if (!(emittedCosine > 0.0f) || emitter.emission == glm::vec3(0.0f) ||
        !scene->visible(reflector.point, emitter))
        return glm::vec3(0.0f);
    const float density = emissive.density(at) * distance * distance / emittedCosine;
    return emitter.emission *
           (reflectance(reflector, direction, cosine) / (density + densityOf(reflector, direction)));
}

Arrival LightSampling::follow(const SurfacePoint& point, glm::vec3 direction, float density) const {
    const Ray ray{point.position + point.geometricNormal * point.clearance, direction};
    Arrival arrival;
    arrival.hit = scene->locate(ray);
    if (!anyExtended) return arrival;
    arrival.light = arrival.hit ? emitted(*arrival.hit, direction, density) : scene->scene().environment;
    arrival.light += areasAlong(
        ray, arrival.hit ? arrival.hit->distance : std::numeric_limits<float>::infinity(), density);
    return arrival;
}

glm::vec3 LightSampling::emitted(const LocationHit& hit, glm::vec3 direction, float density) const {
    const float perArea = emissive.density(hit.location);
    if (!(perArea > 0.0f)) return glm::vec3(0.0f);
    const SurfacePoint emitter = scene->surfaceAt(hit.location, direction);
    const float emittedCosine = -glm::dot(direction, emitter.geometricNormal);
    if (!(emittedCosine > 0.0f)) return glm::vec3(0.0f);
    const float perSolidAngle = perArea * hit.distance * hit.distance / emittedCosine;
    return emitter.emission * (density / (density + perSolidAngle));
}

// Area lights are no surfaces: they hide nothing, but what lies before them hides them.
glm::vec3 LightSampling::areasAlong(const Ray& ray, float hitDistance, float density) const {
    glm::vec3 sum(0.0f);
    for (const Light& light : scene->scene().lights) {
        const float emittedCosine = -glm::dot(ray.direction, light.direction);
        if (light.type != LightType::area || !(emittedCosine > 0.0f)) continue;
        const float distance = glm::dot(ray.origin - light.position, light.direction) / emittedCosine;
        const float clearance = (clearanceOf(light) + endClearance(distance)) / emittedCosine;
        if (!(distance > 0.0f) || !(distance - clearance < hitDistance)) continue;
        const glm::vec3 place = ray.origin + ray.direction * distance - light.position;
        if (std::abs(glm::dot(place, light.right)) > 0.5f * light.size.x ||
            std::abs(glm::dot(place, upOf(light))) > 0.5f * light.size.y)
            continue;
        sum += light.intensity * (density / (density + areaDensity(light, distance, emittedCosine)));
    }
    return sum;
}

} // namespace rebound::lab
