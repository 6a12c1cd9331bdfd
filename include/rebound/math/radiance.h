// SPDX-License-Identifier: MIT
// Light that comes from a host. Kernel language.
#ifndef REBOUND_RADIANCE_H
#define REBOUND_RADIANCE_H

// Half floats end there; brighter surfaces count as that bright. [W m^-2 sr^-1]
const float maximumRadiance = 65504.0f;

// Whether every component is a number.
RB_FUNCTION Mask isFinite3(Vec3 v) { return isFinite(v.x) && isFinite(v.y) && isFinite(v.z); }

// Within 0 and maximumRadiance; nothing where a component is no number.
RB_FUNCTION Vec3 soundRadiance(Vec3 v) {
    return select(isFinite3(v), min(max(v, 0.0f), maximumRadiance), Vec3(0.0f));
}

#endif
