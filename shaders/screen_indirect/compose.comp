// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/screen_indirect_constants.h"
#include "rebound/math/composition.h"

// The picture with indirect light.                                                  [RR-7162, sec. 4]
RB_KERNEL(Compose)
RB_INPUT(0, indirect)
RB_INPUT(1, albedo)
RB_INPUT(2, lit)
RB_OUTPUT(3, rgba16f, composed)
RB_CONSTANTS(4, UpsampleConstants, k)
RB_MAIN(pixel, k.extent)
    Vec4 e = fetch(indirect, pixel);
    Vec4 a = fetch(albedo, pixel);
    Vec4 l = fetch(lit, pixel);
    Vec3 sum = composition(Vec3(l.x, l.y, l.z), Vec3(a.x, a.y, a.z), Vec3(e.x, e.y, e.z));
    store(composed, pixel, Vec4(sum.x, sum.y, sum.z, Real(1.0f)));
RB_END_KERNEL
