// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/bilateral.h"
#include "rebound/math/upsample.h"
#include "rebound/math/composition.h"

// Indirect light at full resolution, straight into the picture.
RB_KERNEL(UpsampleCompose)
RB_FEATURE(0, projection, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_TEXTURE_OF_ANY_SIZE(2, startSurfaces)
RB_TEXTURE_OF_ANY_SIZE(3, startIndirect)
RB_CONSTANTS(4, CameraConstants, camera)
RB_CONSTANTS(5, UpsampleConstants, k)
RB_INPUT(6, albedo)
RB_INPUT(7, lit)
RB_OUTPUT(8, rgba16f, composed)
RB_INPUT(9, radiance)
RB_MAIN(pixel, k.extent)
    Vec3 light = receivedByPixel(startSurfaces, startIndirect, pixel, fetch(depth, pixel), fetch(normal, pixel),
                                 fetch(radiance, pixel), camera, k, projection);
    Vec4 a = fetch(albedo, pixel);
    Vec4 l = fetch(lit, pixel);
    Vec3 sum = composition(Vec3(l.x, l.y, l.z), Vec3(a.x, a.y, a.z), light);
    store(composed, pixel, Vec4(sum.x, sum.y, sum.z, Real(1.0f)));
RB_END_KERNEL
