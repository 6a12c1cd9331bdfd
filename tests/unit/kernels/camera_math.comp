// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/packing.h"
#include "rebound/math/view_position.h"
#include "rebound/math/gbuffer.h"
#include "test_constants.h"

// What becomes of a G-buffer's pixel.
RB_KERNEL(CameraMath)
RB_FEATURE(0, mode, cameraModeCount)
RB_FEATURE(1, projection, 2)
RB_INPUT(0, depth)
RB_INPUT(1, normal)
RB_OUTPUT(2, rgba32f, result)
RB_CONSTANTS(3, CameraConstants, camera)
RB_CONSTANTS(4, CameraMathConstants, k)
RB_MAIN(pixel, k.extent)
    Real stored = fetch(depth, pixel).x;
    Vec4 n = fetch(normal, pixel);
    Vec3 storedNormal = Vec3(n.x, n.y, n.z);
    Vec2 center = pixelCenter(pixel);
    Vec3 position = viewPosition(viewRay(camera, center), linearDepth(camera, stored), projection);
    Vec3 direction = viewNormal(camera, storedNormal);
    Vec4 r = Vec4(0.0f);
    if (mode == cameraPosition) r = Vec4(position.x, position.y, position.z, Real(0.0f));
    if (mode == cameraNormal) r = Vec4(direction.x, direction.y, direction.z, Real(0.0f));
    if (mode == cameraArea) r.x = pixelArea(camera, position, direction, k.scale.x, projection);
    if (mode == cameraSurface || mode == cameraSurfaceArea) {
        Surface s = surfaceOf(camera, center, stored, storedNormal, k.scale.x, projection);
        r = Vec4(s.normal.x, s.normal.y, s.normal.z, s.z);
        if (mode == cameraSurfaceArea) r = Vec4(s.areaOverPi);
    }
    store(result, pixel, r);
RB_END_KERNEL
