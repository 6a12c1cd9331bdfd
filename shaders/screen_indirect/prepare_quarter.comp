// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/reduction.h"

// The host's G-buffer as a level's texels, one for each sixteen pixels: four become one, twice.
RB_KERNEL(PrepareQuarter)
RB_FEATURE(0, projection, 2)
RB_FEATURE(1, reduction, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_INPUT(2, radiance)                        // diffuse radiance that surfaces send out [W m^-2 sr^-1]
RB_IMAGE(3, rgba32f, surfaceOut)
RB_IMAGE(4, rgba16f, lightOut)
RB_CONSTANTS(5, CameraConstants, camera)
RB_CONSTANTS(6, ReduceConstants, k)
RB_MAIN(pixel, k.extent)
    Vec2 coordinate = pixelCenter(pixel) * 4.0f;
    LevelTexel quads[4];
    for (int j = 0; j < 4; ++j) {
        ivec2 block = ivec2(2 * (j & 1), 2 * (j >> 1));
        Vec2 blockCoordinate = Vec2(coordinate.x + (float(block.x) - 1.0f), coordinate.y + (float(block.y) - 1.0f));
        LevelTexel fine[4];
        RB_UNROLL
        for (int i = 0; i < 4; ++i) {
            ivec2 offset = ivec2(i & 1, i >> 1);
            Vec2 fineCoordinate =
                Vec2(blockCoordinate.x + (float(offset.x) - 0.5f), blockCoordinate.y + (float(offset.y) - 0.5f));
            fine[i] = texelOf(camera, fineCoordinate, fetchQuarter(depth, pixel, block + offset),
                              fetchQuarter(normal, pixel, block + offset),
                              fetchQuarter(radiance, pixel, block + offset), k.scale.y, projection);
        }
        quads[j] = reduceFour(fine, camera, blockCoordinate, 1.0f, reduction, projection);
    }
    LevelTexel coarse = reduceFour(quads, camera, coordinate, 2.0f, reduction, projection);
    store(surfaceOut, pixel, packSurface(coarse.surface));
    store(lightOut, pixel, packLight(coarse));
RB_END_KERNEL
