// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/form_factor.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"

// One level's ring of samples, gathered for each texel of that level. The four texels of a 2x2 block take four
// patterns.                                                                        [RR-7162, sec. 3.2]
RB_KERNEL(Gather)
RB_FEATURE(0, projection, 2)
RB_FEATURE(1, formFactor, 2)
RB_SPARSE_TEXTURE(0, surfaces)
RB_SPARSE_TEXTURE(1, light)
RB_IMAGE(2, rgba16f, indirect)               // irradiance over pi [W m^-2 sr^-1]
RB_BUFFER(3, RingSample, ring)
RB_CONSTANTS(4, CameraConstants, camera)
RB_CONSTANTS(5, GatherConstants, k)
RB_MAIN(pixel, k.extent)
    for (int turn = 0; turn < sparseCount(pixel, k.extent.x); ++turn) {
        SparsePixel at = sparsePixel(pixel, turn);
        Surface receiver = unpackSurface(fetch(surfaces, at));
        Vec3 n = receiver.normal;
        Vec2 ray = viewRay(camera, pixelCenter(at) * k.scale.x);
        Vec3 x = viewPosition(ray, receiver.z, projection);
        vec2 step = vec2(k.scale.x * camera.ray.x, k.scale.x * camera.ray.y);
        Vec3 sum = Vec3(0.0f);
        int first = k.extent.w * ((columnOf(at) & 1) + 2 * (rowOf(at) & 1));
        for (int i = first; i < first + k.extent.z; ++i) {
            ivec2 offset = ring[i].offset;
            if (!reaches(surfaces, at, offset)) continue;
            Vec4 sender = fetchOffset(surfaces, at, offset);
            Vec4 l = fetchOffset(light, at, offset);
            Vec2 senderRay = Vec2(ray.x + float(offset.x) * step.x, ray.y + float(offset.y) * step.y);
            Vec3 d = viewPosition(senderRay, senderDistance(sender, l), projection) - x;
            // A receiver is no sender to itself: both cosines are 0, and the distance must not be.
            Real d2 = max(dot(d, d), Real(1e-30f));
            Real inverse = inverseSqrt(d2);
            Real cosReceiver = max(dot(n, d) * inverse, Real(0.0f));
            // The sender's normal is as long as its area over pi.
            Real disc = max(-dot(Vec3(sender.x, sender.y, sender.z), d) * inverse, Real(0.0f));
            Real factor = formFactor == pointFormFactor ? pointToPoint(cosReceiver, disc, d2)
                                                        : pointToDisc(cosReceiver, disc, d2);
            sum += Vec3(l.x, l.y, l.z) * (factor * ring[i].weight);
        }
        store(indirect, at, Vec4(sum.x, sum.y, sum.z, Real(0.0f)));
    }
RB_END_KERNEL
