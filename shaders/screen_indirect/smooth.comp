// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/bilateral.h"
#include "rebound/math/smoothing.h"

// The coarsest level's ring, which has nothing to be combined with.
RB_KERNEL(Smooth)
RB_FEATURE(0, projection, 2)
RB_TEXTURE(0, surfaces)
RB_TEXTURE(1, gathered)
RB_IMAGE(2, rgba16f, result)                 // irradiance over pi [W m^-2 sr^-1]
RB_CONSTANTS(3, CameraConstants, camera)
RB_CONSTANTS(4, UpsampleConstants, k)
RB_MAIN(pixel, k.extent)
    Surface receiver = unpackSurface(fetch(surfaces, pixel));
    Vec3 light = smoothedGather(surfaces, gathered, pixel, receiver, camera, k.scale.x, projection);
    store(result, pixel, Vec4(light.x, light.y, light.z, Real(0.0f)));
RB_END_KERNEL
