// SPDX-License-Identifier: MIT
// View-space positions and areas of pixels. View space has x and y as the engine's and z along the viewing axis.
// Kernel language.
#ifndef REBOUND_VIEW_POSITION_H
#define REBOUND_VIEW_POSITION_H

// A pixel's ray: x, y at z = 1, or, orthographic, x, y everywhere.
//   pixelCoordinate   of the pixel's centre, full resolution
RB_FUNCTION Vec2 viewRay(CameraConstants camera, Vec2 pixelCoordinate) {
    return Vec2(pixelCoordinate.x * camera.ray.x + camera.ray.z,
                pixelCoordinate.y * camera.ray.y + camera.ray.w);
}

// The point of a ray at a distance z along the viewing axis [m].
RB_FUNCTION Vec3 viewPosition(Vec2 ray, Real z, int projection) {
    if (projection == orthographicProjection) return Vec3(ray.x, ray.y, z);
    return Vec3(ray.x * z, ray.y * z, z);
}

// The inverse of a texel's width at a distance along the viewing axis [m^-1].
//   inverseZ   of the distance                                                              [m^-1]
//   scale      full-resolution pixels a texel
RB_FUNCTION Real inverseTexelWidth(CameraConstants camera, Real inverseZ, float scale, int projection) {
    float inverse = 1.0f / (scale * max(abs(camera.ray.x), abs(camera.ray.y)));
    if (projection == orthographicProjection) return Real(inverse);
    return inverseZ * inverse;
}

// Distance along the viewing axis of a stored depth [m].
RB_FUNCTION Real linearDepth(CameraConstants camera, Real stored) {
    return (stored * camera.depth.y + camera.depth.x) * reciprocal(stored * camera.depth.w + camera.depth.z);
}

// View-space normal of a stored one; not yet of unit length.
RB_FUNCTION Vec3 viewNormal(CameraConstants camera, Vec3 stored) {
    return Vec3(stored.x * camera.normalX.x + stored.y * camera.normalX.y + stored.z * camera.normalX.z +
                    camera.normalX.w,
                stored.x * camera.normalY.x + stored.y * camera.normalY.y + stored.z * camera.normalY.z +
                    camera.normalY.w,
                stored.x * camera.normalZ.x + stored.y * camera.normalZ.y + stored.z * camera.normalZ.z +
                    camera.normalZ.w);
}

// Area of the surface that a full-resolution pixel covers: z^2 4 tan(fh/2) tan(fv/2) / (W H) * cos(alpha) / cos(beta);
// orthographic: the pixel's area over cos(beta).                   [RR-7162, eq. 2; m^2]
//   position        of the pixel's surface, view space                                    [m]
//   minimumCosine   cos(beta) is not taken smaller: it vanishes at grazing pixels
RB_FUNCTION Real pixelArea(CameraConstants camera, Vec3 position, Vec3 normal, float minimumCosine,
                           int projection) {
    float cell = abs(camera.ray.x * camera.ray.y);
    if (projection == orthographicProjection)
        return Real(cell) * reciprocal(max(-normal.z, Real(minimumCosine)));
    // With cos(alpha) = z / |p| and cos(beta) = -n.p / |p| the lengths cancel but for the clamp.
    Real distance2 = dot(position, position);
    Real facing = max(-dot(normal, position), distance2 * inverseSqrt(distance2) * minimumCosine);
    return position.z * position.z * position.z * cell * reciprocal(facing);
}

#endif
