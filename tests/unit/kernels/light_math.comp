// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/form_factor.h"
#include "rebound/math/packing.h"
#include "rebound/math/bilateral.h"
#include "test_constants.h"

// One formula on a pixel's operands.
RB_KERNEL(LightMath)
RB_FEATURE(0, mode, lightModeCount)
RB_INPUT(0, first)
RB_INPUT(1, second)
RB_OUTPUT(2, rgba32f, result)
RB_CONSTANTS(3, GridConstants, k)
RB_MAIN(pixel, k.extent)
    Vec4 a = fetch(first, pixel);
    Vec4 b = fetch(second, pixel);
    Vec4 r = Vec4(0.0f);
    if (mode == lightDisc) r.x = pointToDisc(a.x, a.y, a.z);
    if (mode == lightPoint) r.x = pointToPoint(a.x, a.y, a.z);
    if (mode == lightBilateral) {
        r.x = likenessOfNormals(Vec3(0.0f, 0.0f, 1.0f), Vec3(b.x, b.y, b.z)) *
              nearness(Real(1.0f), planeApartness(a.x));
    }
    if (mode == lightUnpacked || mode == lightUnpackedArea) {
        LevelTexel t;
        t.surface.normal = Vec3(a.x, a.y, a.z);
        t.surface.z = a.w;
        t.surface.areaOverPi = b.x;
        t.senderZ = b.y;
        t.radiance = Vec3(b.z, b.z, b.z);
        LevelTexel u = unpackTexel(packSurface(t.surface), packLight(t));
        Surface s = u.surface;
        r = Vec4(s.normal.x, s.normal.y, s.normal.z, s.z);
        if (mode == lightUnpackedArea) r = Vec4(s.areaOverPi, u.senderZ, u.radiance.x, u.radiance.z);
    }
    store(result, pixel, r);
RB_END_KERNEL
