// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// The mean, and behind it that of the frame before.
RB_KERNEL(SumShow)
RB_TEXTURE(0, mean)
RB_TEXTURE(1, previous)
RB_OUTPUT(2, rgba32f, shown)
RB_CONSTANTS(3, SumConstants, k)
RB_MAIN(pixel, k.extent)
    Vec4 m = fetch(mean, pixel);
    Real before = fetch(previous, pixel).x;
    store(shown, pixel, Vec4(m.x, m.y, m.z + m.w * 4096.0f, before));
RB_END_KERNEL
