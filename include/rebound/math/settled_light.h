// SPDX-License-Identifier: MIT
// When bounces have come to rest. Kernel language.
#ifndef REBOUND_SETTLED_LIGHT_H
#define REBOUND_SETTLED_LIGHT_H

// Sums of a hundred links go on to change in their last places for ever, as harmonics are negative in places. A cache whose light
// would move by less than this share of its mean keeps what it has: 32 roundings of a float, 2^-19.
const float closeShare = 1.9073486e-6f;

// Whether a coefficient is as before, but for that.
//   mean   coefficient 0 of the same colour
RB_FUNCTION Mask isClose(Real now, Real before, Real mean) {
    return abs(now - before) <= abs(mean) * closeShare;
}

#endif
