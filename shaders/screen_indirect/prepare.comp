// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"

// The host's G-buffer as a level's texels, one for each pixel.
RB_KERNEL(Prepare)
RB_FEATURE(0, projection, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_INPUT(2, radiance)                        // diffuse radiance that surfaces send out [W m^-2 sr^-1]
RB_IMAGE(3, rgba32f, surfaceOut)
RB_IMAGE(4, rgba16f, lightOut)
RB_CONSTANTS(5, CameraConstants, camera)
RB_CONSTANTS(6, ReduceConstants, k)
RB_MAIN(pixel, k.extent)
    LevelTexel texel = texelOf(camera, pixelCenter(pixel), fetch(depth, pixel), fetch(normal, pixel),
                               fetch(radiance, pixel), k.scale.y, projection);
    store(surfaceOut, pixel, packSurface(texel.surface));
    store(lightOut, pixel, packLight(texel));
RB_END_KERNEL
