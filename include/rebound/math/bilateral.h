// SPDX-License-Identifier: MIT
// Weights of joint bilateral filters. Kernel language.
#ifndef REBOUND_BILATERAL_H
#define REBOUND_BILATERAL_H

// How far a texel's surface agrees with the receiver's, 0 to 1.
//   planeDistance   of the texel's position from the receiver's tangent plane, in texels: agreement ends at 2
//   cosine2         square of the cosine between the two normals, 0 where they face apart; agreement is its 4th power
RB_FUNCTION Real bilateralWeight(Real planeDistance, Real cosine2)
{
    Real depthAgreement = max(Real(1.0f) - planeDistance * planeDistance * 0.25f, Real(0.0f));
    Real normalAgreement = cosine2 * cosine2;
    Real agreement = depthAgreement * normalAgreement;
    return agreement * agreement;
}

// A texel's width at the receiver, inverse.
//   texel   width at z = 1, or, orthographic, everywhere                                    [m]
RB_FUNCTION Real inverseTexelWidth(Real z, float texel, int projection)
{
    if (projection == orthographicProjection) return Real(1.0f / texel);
    return reciprocal(max(z * texel, Real(1e-30f)));
}

#endif
