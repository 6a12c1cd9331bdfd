// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "rebound/math/bilateral.h"
#include "rebound/math/upsample.h"

// A level's own ring, and everything that coarser levels gathered.
RB_KERNEL(Combine)
RB_FEATURE(0, projection, 2)
RB_TEXTURE(0, surfaces)
RB_TEXTURE_OF_ANY_SIZE(1, coarseSurfaces)
RB_TEXTURE_OF_ANY_SIZE(2, coarseIndirect)
RB_IMAGE(3, rgba16f, combined)               // irradiance over pi [W m^-2 sr^-1]
RB_CONSTANTS(4, CameraConstants, camera)
RB_CONSTANTS(5, UpsampleConstants, k)
RB_TEXTURE(6, gathered)
RB_MAIN(pixel, k.extent)
    Surface receiver = unpackSurface(fetch(surfaces, pixel));
    Vec3 light = receivedByTexel(coarseSurfaces, coarseIndirect, pixel, receiver, camera, k, projection);
    Vec4 own = fetch(gathered, pixel);
    light += Vec3(own.x, own.y, own.z);
    store(combined, pixel, Vec4(light.x, light.y, light.z, Real(0.0f)));
RB_END_KERNEL
