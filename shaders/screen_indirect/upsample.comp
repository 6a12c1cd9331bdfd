// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/bilateral.h"
#include "rebound/math/upsample.h"

// Indirect light at full resolution.
RB_KERNEL(Upsample)
RB_FEATURE(0, projection, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_TEXTURE_OF_ANY_SIZE(2, startSurfaces)
RB_TEXTURE_OF_ANY_SIZE(3, startIndirect)
RB_CONSTANTS(4, CameraConstants, camera)
RB_CONSTANTS(5, UpsampleConstants, k)
RB_OUTPUT(6, rgba16f, indirect)              // irradiance over pi [W m^-2 sr^-1]
RB_INPUT(7, radiance)
RB_MAIN(pixel, k.extent)
    Vec3 light = receivedByPixel(startSurfaces, startIndirect, pixel, fetch(depth, pixel), fetch(normal, pixel),
                                 fetch(radiance, pixel), camera, k, projection);
    store(indirect, pixel, Vec4(light.x, light.y, light.z, Real(1.0f)));
RB_END_KERNEL
