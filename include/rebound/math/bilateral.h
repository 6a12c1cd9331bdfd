// SPDX-License-Identifier: MIT
// Weights of joint bilateral filters. Kernel language.
#ifndef REBOUND_BILATERAL_H
#define REBOUND_BILATERAL_H

// How far a texel's surface agrees with the receiver's, up to 1. Near a Gaussian of one texel in the distance, but with
// a longer tail, so that where nothing agrees what lies nearest and faces alike still decides.
//   planeDistance2  squared distance of the texel's position from the receiver's tangent plane, in texels
//   cosine2         square of the cosine between the two normals, 0 where they face apart
RB_FUNCTION Real bilateralWeight(Real planeDistance2, Real cosine2) {
    // Beyond that the reciprocal would be of infinity.
    Real nearness = reciprocal(min(planeDistance2 * 0.125f, Real(1e30f)) + 1.0f);
    Real normalAgreement = cosine2 * cosine2;
    nearness = nearness * nearness;
    return (normalAgreement * normalAgreement + cosine2 * 1e-4f + 1e-7f) * nearness * nearness;
}

#endif
