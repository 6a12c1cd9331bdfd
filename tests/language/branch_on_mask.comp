// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"

RB_KERNEL(BranchOnMask)
RB_INPUT(0, source)
RB_OUTPUT(1, rgba16f, brightened)
RB_MAIN(pixel, imageSize(brightened))
    Vec4 v = fetch(source, pixel);
    Real a = v.x, b = v.y;
    if (a < b) a = b;
    store(brightened, pixel, Vec4(a, a, a, a));
RB_END_KERNEL
