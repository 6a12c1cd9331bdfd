// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/input_check_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/input_statistics.h"

// The correlation of stored normals s with the normals g of the surface through neighbouring pixels, under one reading of
// depth: sum of g s^T. The mean cosine between g and M s + b is linear in it, so the host can try every M and b.
// In the order of GeometryStatistic (rebound/detail/input_check_statistics.inl).
RB_KERNEL(Geometry)
RB_FEATURE(0, projection, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_IMAGE(2, rgba32f, sums0)
RB_IMAGE(3, rgba32f, sums1)
RB_IMAGE(4, rgba32f, sums2)
RB_IMAGE(5, rgba32f, sums3)
RB_CONSTANTS(6, CameraConstants, camera)
RB_CONSTANTS(7, DepthReading, reading)
RB_CONSTANTS(8, TileConstants, k)
RB_MAIN(pixel, k.grid)
    Vec4 s0 = Vec4(0.0f);
    Vec4 s1 = Vec4(0.0f);
    Vec4 s2 = Vec4(0.0f);
    Vec4 s3 = Vec4(0.0f);
    for (int j = 0; j < k.grid.w; ++j)
        for (int i = 0; i < k.grid.z; ++i) {
            ivec2 offset = ivec2(i * k.grid.x, j * k.grid.y);
            Vec2 at = pixelCenter(pixel) + Vec2(Real(float(offset.x)), Real(float(offset.y)));
            Vec3 center = readPosition(reading, camera, at, fetchOffset(depth, pixel, offset).x, projection);
            Vec3 left = readPosition(reading, camera, Vec2(at.x - 1.0f, at.y),
                                     fetchOffset(depth, pixel, offset + ivec2(-1, 0)).x, projection);
            Vec3 right = readPosition(reading, camera, Vec2(at.x + 1.0f, at.y),
                                      fetchOffset(depth, pixel, offset + ivec2(1, 0)).x, projection);
            Vec3 above = readPosition(reading, camera, Vec2(at.x, at.y - 1.0f),
                                      fetchOffset(depth, pixel, offset + ivec2(0, -1)).x, projection);
            Vec3 below = readPosition(reading, camera, Vec2(at.x, at.y + 1.0f),
                                      fetchOffset(depth, pixel, offset + ivec2(0, 1)).x, projection);
            Mask surface = liesInside(at, k.size, 1.0f) && center.z > 0.0f && left.z > 0.0f && right.z > 0.0f &&
                           above.z > 0.0f && below.z > 0.0f;
            // In texels: products of differences stay floats at any scale.
            Real inverseWidth = inverseTexelWidth(camera, reciprocal(max(center.z, Real(1e-30f))), 1.0f, projection);
            Vec3 g = unitOrZero(cross((right - center) * inverseWidth, (below - center) * inverseWidth));
            Vec3 other = unitOrZero(cross((left - center) * inverseWidth, (above - center) * inverseWidth));
            // Where a surface ends or bends, the two triangles differ.
            Vec4 storedNormal = fetchOffset(normal, pixel, offset);
            Vec3 s = Vec3(storedNormal.x, storedNormal.y, storedNormal.z);
            Real s2Length = dot(s, s);
            Mask judged = surface && dot(g, other) > 0.95f && isFinite3(s) && s2Length > 1e-6f && s2Length < 100.0f;
            s = select(judged, s, Vec3(0.0f));
            Vec3 view = projection == orthographicProjection ? Vec3(0.0f, 0.0f, 1.0f) : center;
            g = select(dot(g, view) > 0.0f, -g, g);
            g = select(judged, g, Vec3(0.0f));
            Vec3 decoded = s * 2.0f - Vec3(1.0f);
            s0 += Vec4(g.x * s.x, g.x * s.y, g.x * s.z, g.x);
            s1 += Vec4(g.y * s.x, g.y * s.y, g.y * s.z, g.y);
            s2 += Vec4(g.z * s.x, g.z * s.y, g.z * s.z, g.z);
            s3 += Vec4(length(s), select(judged, length(decoded), Real(0.0f)), count(judged), count(surface));
        }
    store(sums0, pixel, s0);
    store(sums1, pixel, s1);
    store(sums2, pixel, s2);
    store(sums3, pixel, s3);
RB_END_KERNEL
