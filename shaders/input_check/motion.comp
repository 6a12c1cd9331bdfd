// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/input_check_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/reprojection.h"
#include "rebound/math/input_statistics.h"

// The signs of a reading, in the order of all readings: as stated, turned round, y, x.
RB_FUNCTION Vec4 agreements(Vec2 motion, float scaleX, float scaleY, Vec2 expected, Mask judged)
{
    Real x = Real(scaleX);
    Real y = Real(scaleY);
    return Vec4(motionAgrees(motion, x, y, expected, judged), motionAgrees(motion, -x, -y, expected, judged),
                motionAgrees(motion, x, -y, expected, judged), motionAgrees(motion, -x, y, expected, judged));
}

// Motion vectors against what depth and both cameras give for a scene that stands still. Of surfaces: .x no number,
// .y expected to move by more than a pixel, .z to stand still, .w to stand still but moved by more than two; then how many
// of those that move agree with each of twelve readings.
RB_KERNEL(Motion)
RB_FEATURE(0, projection, 2)
RB_INPUT(0, depth)
RB_INPUT(1, motion)
RB_IMAGE(2, rgba32f, sums0)
RB_IMAGE(3, rgba32f, sums1)
RB_IMAGE(4, rgba32f, sums2)
RB_IMAGE(5, rgba32f, sums3)
RB_CONSTANTS(6, CameraConstants, camera)
RB_CONSTANTS(7, MotionConstants, cameras)
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
            Real d = fetchOffset(depth, pixel, offset).x;
            Vec4 texel = fetchOffset(motion, pixel, offset);
            Mask surface = liesInside(at, k.size, 0.0f) && holdsSurface(camera, d);
            Mask number = surface && isFinite(texel.x) && isFinite(texel.y);
            Vec2 m = select(number, Vec2(texel.x, texel.y), Vec2(0.0f));
            Vec3 p = viewPosition(viewRay(camera, at), select(surface, linearDepth(camera, d), Real(1.0f)), projection);
            Vec3 before = reprojected(cameras.previous, p);
            Real w = before.z;
            Mask visible = number && w > p.z * 0.01f;
            if (projection == orthographicProjection) visible = number;
            w = select(visible, w, Real(1.0f));
            Vec2 expected = select(visible, Vec2(before.x / w - at.x, before.y / w - at.y), Vec2(0.0f));
            Real e2 = dot(expected, expected);
            float reach = max(k.size.x, k.size.y);
            visible = visible && e2 < reach * reach;
            Mask moving = visible && e2 > 1.0f;
            Mask still = visible && !(e2 > 1.0f);
            Vec2 off = Vec2(m.x * cameras.units.x - expected.x, m.y * cameras.units.y - expected.y);
            s0 += Vec4(count(surface && !number), count(moving), count(still), count(still && dot(off, off) > 4.0f));
            s1 += agreements(m, cameras.units.x, cameras.units.y, expected, moving);
            s2 += agreements(m, cameras.units.z, cameras.units.w, expected, moving);
            s3 += agreements(m, cameras.moreUnits.x, cameras.moreUnits.y, expected, moving);
        }
    store(sums0, pixel, s0);
    store(sums1, pixel, s1);
    store(sums2, pixel, s2);
    store(sums3, pixel, s3);
RB_END_KERNEL
