// SPDX-License-Identifier: MIT
// Exponents of lobes that come from a host. Kernel language.
#ifndef REBOUND_SOUND_EXPONENT_H
#define REBOUND_SOUND_EXPONENT_H

// Sharper lobes than this are beyond four bands.
const float sharpestExponent = 64.0f;

// Within 0 and that; what is no number is as dull as can be.
RB_FUNCTION Real soundExponent(Real exponent) {
    return select(isFinite(exponent), clamp(exponent, Real(0.0f), Real(sharpestExponent)), Real(0.0f));
}

#endif
