// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/input_check_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/input_statistics.h"

// Counts surfaces by what their albedo holds. In the order of AlbedoStatistic (rebound/detail/input_check_statistics.inl).
RB_KERNEL(Reflectance)
RB_INPUT(0, depth)
RB_INPUT(1, albedo)
RB_IMAGE(2, rgba32f, sums0)
RB_IMAGE(3, rgba32f, sums1)
RB_IMAGE(4, rgba32f, sums2)
RB_IMAGE(5, rgba32f, sums3)
RB_CONSTANTS(6, CameraConstants, camera)
RB_CONSTANTS(7, TileConstants, k)
RB_MAIN(pixel, k.grid)
    Vec4 s0 = Vec4(0.0f);
    Vec4 s1 = Vec4(0.0f);
    for (int j = 0; j < k.grid.w; ++j)
        for (int i = 0; i < k.grid.z; ++i) {
            ivec2 offset = ivec2(i * k.grid.x, j * k.grid.y);
            Vec2 coordinate = pixelCenter(pixel) + Vec2(Real(float(offset.x)), Real(float(offset.y)));
            Mask surface = liesInside(coordinate, k.size, 0.0f) &&
                           holdsSurface(camera, fetchOffset(depth, pixel, offset).x);
            Vec4 texel = fetchOffset(albedo, pixel, offset);
            Vec3 a = Vec3(texel.x, texel.y, texel.z);
            Mask number = surface && isFinite3(a);
            // Half floats and filtering leave a little below 0 and above 1.
            s0 += Vec4(count(surface), count(surface && !isFinite3(a)), count(number && smallest(a) < -0.01f),
                       count(number && largest(a) > 1.01f));
            s1 += Vec4(count(number && smallest(a) > 0.999f && largest(a) < 1.01f), count(number && largest(a) < 1e-4f),
                       select(number, (a.x + a.y + a.z) * 0.333333333f, Real(0.0f)), Real(0.0f));
        }
    store(sums0, pixel, s0);
    store(sums1, pixel, s1);
    store(sums2, pixel, Vec4(0.0f));
    store(sums3, pixel, Vec4(0.0f));
RB_END_KERNEL
