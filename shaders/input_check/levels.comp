// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/input_check_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/input_statistics.h"

RB_FUNCTION Vec4 countAbove(Real value, float bound, float step, Mask m)
{
    return Vec4(count(m && value > bound), count(m && value > bound * step), count(m && value > bound * step * step),
                count(m && value > bound * step * step * step));
}

// Histograms of depth and of radiance: how many surfaces exceed each of eight bounds.
RB_KERNEL(Levels)
RB_INPUT(0, depth)
RB_INPUT(1, radiance)
RB_IMAGE(2, rgba32f, sums0)
RB_IMAGE(3, rgba32f, sums1)
RB_IMAGE(4, rgba32f, sums2)
RB_IMAGE(5, rgba32f, sums3)
RB_CONSTANTS(6, CameraConstants, camera)
RB_CONSTANTS(7, TileConstants, k)
RB_MAIN(pixel, k.grid)
    float depthStep4 = depthBoundStep * depthBoundStep * depthBoundStep * depthBoundStep;
    float radianceStep4 = radianceBoundStep * radianceBoundStep * radianceBoundStep * radianceBoundStep;
    Vec4 s0 = Vec4(0.0f);
    Vec4 s1 = Vec4(0.0f);
    Vec4 s2 = Vec4(0.0f);
    Vec4 s3 = Vec4(0.0f);
    for (int j = 0; j < k.grid.w; ++j)
        for (int i = 0; i < k.grid.z; ++i) {
            ivec2 offset = ivec2(i * k.grid.x, j * k.grid.y);
            Vec2 coordinate = pixelCenter(pixel) + Vec2(Real(float(offset.x)), Real(float(offset.y)));
            Real d = fetchOffset(depth, pixel, offset).x;
            Mask surface = liesInside(coordinate, k.size, 0.0f) && holdsSurface(camera, d);
            Real z = linearDepth(camera, d);
            s0 += countAbove(z, firstDepthBound, depthBoundStep, surface);
            s1 += countAbove(z, firstDepthBound * depthStep4, depthBoundStep, surface);
            Vec4 light = fetchOffset(radiance, pixel, offset);
            Vec3 l = Vec3(light.x, light.y, light.z);
            Mask bright = surface && isFinite3(l);
            s2 += countAbove(largest(l), firstRadianceBound, radianceBoundStep, bright);
            s3 += countAbove(largest(l), firstRadianceBound * radianceStep4, radianceBoundStep, bright);
        }
    store(sums0, pixel, s0);
    store(sums1, pixel, s1);
    store(sums2, pixel, s2);
    store(sums3, pixel, s3);
RB_END_KERNEL
