// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/input_check_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/input_statistics.h"

// Counts pixels by what their depth and normal hold. In the order of ValueStatistic (rebound/detail/input_check_statistics.inl).
RB_KERNEL(Values)
RB_FEATURE(0, projection, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_IMAGE(2, rgba32f, sums0)
RB_IMAGE(3, rgba32f, sums1)
RB_IMAGE(4, rgba32f, sums2)
RB_IMAGE(5, rgba32f, sums3)
RB_CONSTANTS(6, CameraConstants, camera)
RB_CONSTANTS(7, PlaneConstants, planes)
RB_CONSTANTS(8, TileConstants, k)
RB_MAIN(pixel, k.grid)
    Vec4 s0 = Vec4(0.0f);
    Vec4 s1 = Vec4(0.0f);
    Vec4 s2 = Vec4(0.0f);
    Vec4 s3 = Vec4(0.0f);
    for (int j = 0; j < k.grid.w; ++j)
        for (int i = 0; i < k.grid.z; ++i) {
            ivec2 offset = ivec2(i * k.grid.x, j * k.grid.y);
            Vec2 coordinate = pixelCenter(pixel) + Vec2(Real(float(offset.x)), Real(float(offset.y)));
            Mask inside = liesInside(coordinate, k.size, 0.0f);
            Real d = fetchOffset(depth, pixel, offset).x;
            Vec4 storedNormal = fetchOffset(normal, pixel, offset);
            Vec3 stored = Vec3(storedNormal.x, storedNormal.y, storedNormal.z);
            Mask surface = inside && holdsSurface(camera, d);
            Real z = select(surface, linearDepth(camera, d), Real(1.0f));
            s0 += Vec4(count(inside), count(inside && !isFinite(d)), count(inside && d < 0.0f && isFinite(d)),
                       count(inside && d > 1.0f && isFinite(d)));
            s1 += Vec4(count(inside && d == camera.empty.x), count(surface),
                       count(surface && (z < planes.range.x || z > planes.range.y)),
                       count(inside && d == Real(1.0f - camera.empty.x)));

            Mask number = surface && isFinite3(stored);
            stored = select(number, stored, Vec3(0.0f));
            Vec3 n = viewNormal(camera, stored);
            Vec3 decoded = stored * 2.0f - Vec3(1.0f);
            Real n2 = dot(n, n);
            Real raw2 = dot(stored, stored);
            Real decoded2 = dot(decoded, decoded);
            Vec3 position = viewPosition(viewRay(camera, coordinate), z, projection);
            Vec3 view = projection == orthographicProjection ? Vec3(0.0f, 0.0f, 1.0f) : position;
            Mask away = number && dot(n, view) > 0.1f * sqrt(n2 * dot(view, view));
            // A length within 5 % of 1: normals of 8 bits are off by 1 %.
            s2 += Vec4(count(surface && !isFinite3(Vec3(storedNormal.x, storedNormal.y, storedNormal.z))),
                       count(number && n2 < 1e-6f), count(number && !(abs(n2 - 1.0f) < 0.1f)),
                       select(number, min(sqrt(n2), Real(1e6f)), Real(0.0f)));
            s3 += Vec4(count(number && abs(raw2 - 1.0f) < 0.1f), count(number && abs(decoded2 - 1.0f) < 0.1f),
                       count(number && smallest(stored) > -1e-3f && largest(stored) < 1.001f), count(away));
        }
    store(sums0, pixel, s0);
    store(sums1, pixel, s1);
    store(sums2, pixel, s2);
    store(sums3, pixel, s3);
RB_END_KERNEL
