// SPDX-License-Identifier: MIT
// How much a cache says at a receiver: trilinear weight, times whether it lies in front of the receiver's tangent plane,
// times how much of the cell's receivers around see it. The numbers below are what experiments may tune. Kernel language.
#ifndef REBOUND_CACHE_WEIGHTS_H
#define REBOUND_CACHE_WEIGHTS_H

#include "rebound/math/receiver_offset.h"

// A cache counts whole from this distance in front of the tangent plane on, and not at all behind it. [cells]
const float tangentRamp = 0.25f;
// Baked receivers count for receivers within about these distances of them, and of their planes. [cells]
const float receiverReach = 0.35f;
const float receiverThickness = 0.1f;
// Of a baked receiver that sees every cache: decides where no baked receiver is near, or those that are see none.
const float visibilityPrior = 1e-3f;
// Neither place nor plane makes a weight vanish: where they would for all caches, caches count without them. As small as
// light may not leak, so that nobody sees it elsewhere. Of a cell's sides [cells]; of the ramp [its length].
const float cornerShare = 1e-5f;
const float behindShare = 5e-4f;
// Caches of less than this share of all weights are left out: steps of half floats are larger.
const float negligibleShare = 1e-4f;

// A coordinate in the cell for interpolation.
RB_FUNCTION Real withinCell(Real local) { return clamp(local, Real(cornerShare), Real(1.0f - cornerShare)); }

// Next to nothing behind the receiver's tangent plane, rising to 1 in front of it.
//   distance   of the cache from that plane, positive in front of it [tangentRamp cells]
RB_FUNCTION Real tangentWeight(Real distance) {
    Real t = clamp(distance, Real(behindShare), Real(1.0f));
    return t * t * (Real(3.0f) - t * 2.0f);
}

// How much a baked receiver tells of another one: cosine^2 / ((1 + (distance / reach)^2)^2 (1 + (height / thickness)^2)), with
// the cosine of the angle between both normals, and the height over the baked one's tangent plane [cells].
//   direction     of the baked one's normal, of any length
//   alongNormal   its product with the other one's normal, at least 0
//   apart         from the baked one to the other one [cells]
RB_FUNCTION Real receiverWeight(Vec3 direction, Real alongNormal, Vec3 apart) {
    Real height = dot(direction, apart);
    Real spread = dot(apart, apart) * (1.0f / (receiverReach * receiverReach)) + 1.0f;
    Real off = height * height * (1.0f / (receiverThickness * receiverThickness)) + dot(direction, direction);
    return alongNormal * alongNormal * reciprocal(spread * spread * off);
}

#endif
