// SPDX-License-Identifier: MIT
// Weights of joint bilateral filters. Kernel language.
#ifndef REBOUND_BILATERAL_H
#define REBOUND_BILATERAL_H

// Distance of a point of a ray from the receiver's tangent plane                               [m]
//   receiver      dot of the receiver's normal and position
RB_FUNCTION Real planeDistance(Vec3 normal, Real receiver, Vec2 ray, Real z, int projection) {
    Real across = normal.x * ray.x + normal.y * ray.y;
    if (projection == orthographicProjection) return across + normal.z * z - receiver;
    return (across + normal.z) * z - receiver;
}

// How far a texel lies from the receiver's tangent plane, as a weight's divisor: 1 on the plane.
//   planeDistance2  squared distance of the texel's position from the plane, in texels
RB_FUNCTION Real planeApartness(Real planeDistance2) {
    // Beyond that the reciprocal would be of infinity.
    return min(planeDistance2 * 0.125f, Real(1e30f)) + 1.0f;
}

// How far a texel's surface agrees with the receiver's, up to 1. Near a Gaussian of one texel in the distance, but with
// a longer tail, so that where nothing agrees what lies nearest and faces alike still decides. Distances count beside
// that of the nearest texel: weights are divided by their sum, and without it those of four texels far from the plane
// would all vanish in single precision.
//   nearest       the smallest apartness of all texels that are weighed
//   apartness     the texel's
//   cosine2       square of the cosine between the two normals, 0 where they face apart
RB_FUNCTION Real bilateralWeight(Real nearest, Real apartness, Real cosine2) {
    Real nearness = nearest * reciprocal(apartness);
    Real normalAgreement = cosine2 * cosine2;
    nearness = nearness * nearness;
    return (normalAgreement * normalAgreement + cosine2 * 1e-4f + 1e-7f) * nearness * nearness;
}

// Square of the cosine between the receiver's normal and a texel's of any length, 0 where they face apart.
RB_FUNCTION Real agreementOfNormals(Vec3 normal, Vec3 texel) {
    Real cosine = max(dot(normal, texel), Real(0.0f));
    // The smallest normal float: an empty texel's normal is zero.
    return cosine * cosine * reciprocal(max(dot(texel, texel), Real(1.2e-38f)));
}

#endif
