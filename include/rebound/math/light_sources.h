// SPDX-License-Identifier: MIT
// What light sources send to a place. Kernel language.
#ifndef REBOUND_LIGHT_SOURCES_H
#define REBOUND_LIGHT_SOURCES_H

// The edge of a spot's cone: the square of a ramp, 0 to 1.                  [KHR_lights_punctual, inner and outer cone angles]
//   cosine   of the angle off its axis
RB_FUNCTION Real spotShare(LightSource source, Real cosine) {
    float width = source.intensity.w - source.direction.w;
    if (width > 0.0f) {
        Real ramp = clamp((cosine - source.direction.w) * (1.0f / width), Real(0.0f), Real(1.0f));
        return ramp * ramp;
    }
    return select(cosine >= source.direction.w, Real(1.0f), Real(0.0f));
}

// Irradiance with nothing in the way, over the source's intensity.
RB_FUNCTION Real irradianceShare(LightSource source, Vec3 position, Vec3 normal) {
    Vec3 axis = Vec3(Real(source.direction.x), Real(source.direction.y), Real(source.direction.z));
    if (source.kind.x == directionalSource) return max(-dot(normal, axis), Real(0.0f));
    Vec3 towards = Vec3(Real(source.position.x), Real(source.position.y), Real(source.position.z)) - position;
    Real squared = max(dot(towards, towards), Real(1e-12f));
    Vec3 direction = towards * inverseSqrt(squared);
    Real cosine = max(dot(normal, direction), Real(0.0f));
    if (source.kind.x == pointSource) return cosine / squared;
    Real emitted = -dot(direction, axis);
    if (source.kind.x == spotSource) return cosine * spotShare(source, emitted) / squared;
    // A disc's form factor over its area, which is bounded where it is near.    [RR-7162, eq. 4]
    emitted = source.kind.x == discSource ? max(emitted, Real(0.0f)) : abs(emitted);
    return cosine * emitted / (squared + emitted * source.intensity.w);
}

#endif
