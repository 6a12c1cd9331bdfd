// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/reduction.h"

// A level from the one twice as fine.
RB_KERNEL(Reduce)
RB_FEATURE(0, projection, 2)
RB_FEATURE(1, reduction, 2)
RB_TEXTURE(0, surfaces)
RB_TEXTURE(1, light)
RB_IMAGE(2, rgba32f, surfaceOut)
RB_IMAGE(3, rgba16f, lightOut)
RB_CONSTANTS(4, CameraConstants, camera)
RB_CONSTANTS(5, ReduceConstants, k)
RB_MAIN(pixel, k.extent)
    LevelTexel fine[4];
    RB_UNROLL
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        fine[i] = unpackTexel(fetchMinified(surfaces, pixel, offset), fetchMinified(light, pixel, offset));
    }
    LevelTexel coarse = reduceFour(fine, camera, pixelCenter(pixel) * (2.0f * k.scale.x), k.scale.x, reduction, projection);
    store(surfaceOut, pixel, packSurface(coarse.surface));
    store(lightOut, pixel, packLight(coarse));
RB_END_KERNEL
