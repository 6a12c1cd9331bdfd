// SPDX-License-Identifier: MIT
// Weights of joint bilateral filters. Kernel language.
#ifndef REBOUND_BILATERAL_H
#define REBOUND_BILATERAL_H

// Weights are likenessOfNormals() times nearness(): up to 1, near a Gaussian of one texel in the distance from the
// receiver's tangent plane, but with a longer tail, so that where nothing agrees what lies nearest and faces alike still
// decides.

// Distance of a point of a ray from the receiver's tangent plane                               [m]
//   normalZ       of the receiver's normal
//   receiver      dot of the receiver's normal and position
//   across        dot of the receiver's normal's x and y and the ray
RB_FUNCTION Real planeDistance(Real normalZ, Real receiver, Real across, Real z, int projection) {
    if (projection == orthographicProjection) return across + normalZ * z - receiver;
    return (across + normalZ) * z - receiver;
}

// How far a texel lies from the receiver's tangent plane, as a weight's divisor: 1 on the plane.
//   planeDistance  of the texel's position from the plane, in texels
RB_FUNCTION Real planeApartness(Real planeDistance) {
    // Beyond that the reciprocal would be of infinity.
    return min(planeDistance * planeDistance * 0.125f, Real(1e30f)) + 1.0f;
}

// Distances count beside that of the nearest texel: weights are divided by their sum, and without it those of four texels
// far from the plane would all vanish in single precision.
//   nearest       the smallest apartness of all texels that are weighed
//   apartness     the texel's
RB_FUNCTION Real nearness(Real nearest, Real apartness) {
    Real ratio = nearest * roughReciprocal(apartness);
    ratio = ratio * ratio;
    return ratio * ratio;
}

// How far a texel's normal, of any length, agrees with the receiver's.
RB_FUNCTION Real likenessOfNormals(Vec3 normal, Vec3 texel) {
    Real cosine = max(dot(normal, texel), Real(0.0f));
    // The smallest normal float: an empty texel's normal is zero.
    Real cosine2 = cosine * cosine * roughReciprocal(max(dot(texel, texel), Real(1.2e-38f)));
    Real cosine4 = cosine2 * cosine2;
    return cosine4 * cosine4 + cosine2 * 1e-4f + 1e-7f;
}

#endif
