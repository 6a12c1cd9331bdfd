// SPDX-License-Identifier: MIT
// What a level's texels hold. Kernel language.
//
//   surface   xyz: normal, its length the texel's area over pi [m^2]; w: distance along the viewing axis at which the
//             texel receives, that of one surface [m]
//   light     xyz: mean radiance of everything the texel stands for [W m^-2 sr^-1]; w: the mean distance of all that,
//             at which the texel sends, over the former, minus 1
//
// A texel without surface is zero: it neither sends nor receives.
#ifndef REBOUND_PACKING_H
#define REBOUND_PACKING_H

#include "rebound/math/radiance.h"

struct Surface {
    Vec3 normal;     // unit, or zero where there is no surface
    Real z;          // distance along the viewing axis [m]; 0: no surface
    Real areaOverPi; // [m^2]
};

// A texel while levels are built.
struct LevelTexel {
    Surface surface; // as it receives
    Real senderZ;    // distance along the viewing axis at which it sends [m]
    Vec3 radiance;   // [W m^-2 sr^-1]
};

RB_FUNCTION Vec4 packSurface(Surface s) {
    Vec3 n = s.normal * s.areaOverPi;
    return Vec4(n.x, n.y, n.z, s.z);
}

RB_FUNCTION Vec4 packLight(LevelTexel t) {
    Real ratio = t.senderZ * reciprocal(max(t.surface.z, Real(1e-30f))) - 1.0f;
    return Vec4(t.radiance.x, t.radiance.y, t.radiance.z, select(t.surface.z > 0.0f, ratio, Real(0.0f)));
}

RB_FUNCTION Surface unpackSurface(Vec4 surface) {
    Surface s;
    Vec3 scaled = Vec3(surface.x, surface.y, surface.z);
    // The smallest normal float: an empty texel's normal stays zero.
    Real inverse = inverseSqrt(max(dot(scaled, scaled), Real(1.2e-38f)));
    s.normal = scaled * inverse;
    s.areaOverPi = dot(scaled, s.normal);
    s.z = surface.w;
    return s;
}

// Distance along the viewing axis at which a texel sends [m].
RB_FUNCTION Real senderDistance(Vec4 surface, Vec4 light) { return surface.w * light.w + surface.w; }

RB_FUNCTION LevelTexel unpackTexel(Vec4 surface, Vec4 light) {
    LevelTexel t;
    t.surface = unpackSurface(surface);
    t.senderZ = senderDistance(surface, light);
    t.radiance = Vec3(light.x, light.y, light.z);
    return t;
}

#endif
