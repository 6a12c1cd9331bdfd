// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/input_check_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/input_statistics.h"

// Light less what the surface emits itself.
RB_FUNCTION Vec3 reflected(Vec3 light, Vec4 emitted)
{
    return max(light - Vec3(emitted.x, emitted.y, emitted.z), 0.0f);
}

// Counts surfaces by what their light holds, and, with albedo, by how it follows albedo from pixel to pixel.
// In the order of LightStatistic (rebound/detail/input_check_statistics.inl).
RB_KERNEL(Light)
RB_FEATURE(0, projection, 2)
RB_FEATURE(1, withAlbedo, 2)
RB_FEATURE(2, withEmission, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_INPUT(2, albedo)
RB_INPUT(3, emission)
RB_INPUT(4, light)
RB_IMAGE(5, rgba32f, sums0)
RB_IMAGE(6, rgba32f, sums1)
RB_IMAGE(7, rgba32f, sums2)
RB_IMAGE(8, rgba32f, sums3)
RB_CONSTANTS(9, CameraConstants, camera)
RB_CONSTANTS(10, TileConstants, k)
RB_MAIN(pixel, k.grid)
    Vec4 s0 = Vec4(0.0f);
    Vec4 s1 = Vec4(0.0f);
    Vec4 s2 = Vec4(0.0f);
    for (int j = 0; j < k.grid.w; ++j)
        for (int i = 0; i < k.grid.z; ++i) {
            ivec2 offset = ivec2(i * k.grid.x, j * k.grid.y);
            Vec2 at = pixelCenter(pixel) + Vec2(Real(float(offset.x)), Real(float(offset.y)));
            Surface surface = plainSurface(camera, at, fetchOffset(depth, pixel, offset),
                                           fetchOffset(normal, pixel, offset), projection);
            Mask lit = liesInside(at, k.size, 0.0f) && surface.z > 0.0f;
            Vec4 texel = fetchOffset(light, pixel, offset);
            Vec3 l = Vec3(texel.x, texel.y, texel.z);
            Mask number = lit && isFinite3(l);
            s0 += Vec4(count(lit), count(lit && !isFinite3(l)), count(number && smallest(l) < 0.0f),
                       count(number && largest(l) >= 65500.0f));
            s1 += Vec4(count(number && largest(l) <= 0.0f), Real(0.0f), Real(0.0f), Real(0.0f));
            if (withAlbedo == 1) {
                Vec4 ownAlbedo = fetchOffset(albedo, pixel, offset);
                Vec3 a = Vec3(ownAlbedo.x, ownAlbedo.y, ownAlbedo.z);
                if (withEmission == 1) l = reflected(l, fetchOffset(emission, pixel, offset));
                Vec3 position = viewPosition(viewRay(camera, at), surface.z, projection);
                // Few pixels lie at edges: what all others need not know is not fetched.
                RB_UNROLL
                for (int pair = 0; pair < 2; ++pair) {
                    ivec2 o = offset + ivec2(1 - pair, pair);
                    Vec2 there = Vec2(at.x + float(1 - pair), at.y + float(pair));
                    Vec4 otherAlbedo = fetchOffset(albedo, pixel, o);
                    Vec3 a2 = Vec3(otherAlbedo.x, otherAlbedo.y, otherAlbedo.z);
                    Vec3 change = a2 - a;
                    Mask differs = number && liesInside(there, k.size, 0.0f) && isFinite3(change) &&
                                   dot(change, change) > 1e-4f;
                    if (anyLane(differs)) {
                        Vec4 otherTexel = fetchOffset(light, pixel, o);
                        Vec3 l2 = Vec3(otherTexel.x, otherTexel.y, otherTexel.z);
                        if (withEmission == 1) l2 = reflected(l2, fetchOffset(emission, pixel, o));
                        Surface other = plainSurface(camera, there, fetchOffset(depth, pixel, o),
                                                     fetchOffset(normal, pixel, o), projection);
                        // On one surface: neither turned nor off its plane.
                        Vec3 apart = viewPosition(viewRay(camera, there), other.z, projection) - position;
                        Real off = dot(surface.normal, apart);
                        Mask same = differs && other.z > 0.0f && isFinite3(l2) &&
                                    dot(surface.normal, other.normal) > 0.95f && off * off < dot(apart, apart) * 0.1f;
                        Vec3 votes = edgeVote(a.x, a2.x, l.x, l2.x) + edgeVote(a.y, a2.y, l.y, l2.y) +
                                     edgeVote(a.z, a2.z, l.z, l2.z);
                        votes = select(same, votes, Vec3(0.0f));
                        s2 += Vec4(votes.x, votes.y, votes.z, Real(0.0f));
                    }
                }
                // Black surfaces lie beside others rather than on them.
                RB_UNROLL
                for (int pair = 0; pair < 2; ++pair) {
                    ivec2 o = offset + ivec2(16 * (1 - pair), 16 * pair);
                    Vec2 there = Vec2(at.x + float(16 * (1 - pair)), at.y + float(16 * pair));
                    Vec4 otherAlbedo = fetchOffset(albedo, pixel, o);
                    Vec3 a2 = Vec3(otherAlbedo.x, otherAlbedo.y, otherAlbedo.z);
                    Mask dark = number && liesInside(there, k.size, 0.0f) && isFinite3(a) && isFinite3(a2) &&
                                (largest(a) < 0.02f || largest(a2) < 0.02f);
                    if (anyLane(dark)) {
                        Vec4 otherTexel = fetchOffset(light, pixel, o);
                        Vec3 l2 = Vec3(otherTexel.x, otherTexel.y, otherTexel.z);
                        if (withEmission == 1) l2 = reflected(l2, fetchOffset(emission, pixel, o));
                        Mask both = dark && isFinite3(l2) && holdsSurface(camera, fetchOffset(depth, pixel, o).x);
                        Vec2 votes = select(both, darkVote(a, a2, l, l2), Vec2(0.0f));
                        s1 += Vec4(Real(0.0f), Real(0.0f), votes.x, votes.y);
                    }
                }
            }
        }
    store(sums0, pixel, s0);
    store(sums1, pixel, s1);
    store(sums2, pixel, s2);
    store(sums3, pixel, Vec4(0.0f));
RB_END_KERNEL
