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
RB_TEXTURE(2, startSurfaces)
RB_TEXTURE(3, startIndirect)
RB_CONSTANTS(4, CameraConstants, camera)
RB_CONSTANTS(5, UpsampleConstants, k)
RB_OUTPUT(6, rgba16f, indirect)              // irradiance over pi [W m^-2 sr^-1]
RB_INPUT(7, radiance)
RB_MAIN(pixel, k.extent)
    Vec4 n = fetch(normal, pixel);
    Vec2 coordinate = pixelCenter(pixel);
    Surface receiver = surfaceOf(camera, coordinate, fetch(depth, pixel).x, Vec3(n.x, n.y, n.z), 1.0f, projection);
    Vec3 position = viewPosition(viewRay(camera, coordinate), receiver.z, projection);
    Vec3 light = upsampled(startSurfaces, startIndirect, pixel, receiver, position, camera, k.extent.z, k.scale.y,
                           projection);
    // As the pixel sends nothing where its radiance is no number, it receives nothing.
    Vec4 sent = fetch(radiance, pixel);
    light = select(receiver.z > 0.0f && isFinite3(Vec3(sent.x, sent.y, sent.z)), light, Vec3(0.0f));
    store(indirect, pixel, Vec4(light.x, light.y, light.z, Real(1.0f)));
RB_END_KERNEL
