// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// The host's image of integers as one of the device's own.
RB_KERNEL(CopyIntegers)
RB_UINT_INPUT(0, source)
RB_IMAGE(1, rgba32ui, result)
RB_CONSTANTS(2, GridConstants, k)
RB_MAIN(pixel, k.extent)
    store(result, pixel, fetch(source, pixel));
RB_END_KERNEL
