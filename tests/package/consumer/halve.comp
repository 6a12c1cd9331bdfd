// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "halve_constants.h"

RB_KERNEL(Halve)
RB_INPUT(0, whole)
RB_OUTPUT(1, rgba16f, halved)
RB_CONSTANTS(2, HalveConstants, k)
RB_MAIN(pixel, k.extent)
    Vec4 v = fetch(whole, pixel);
    store(halved, pixel, v * 0.5f);
RB_END_KERNEL
