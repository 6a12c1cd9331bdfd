// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// The host's image in half precision.
RB_KERNEL(Halves)
RB_INPUT(0, source)
RB_IMAGE(1, rgba16f, result)
RB_CONSTANTS(2, GridConstants, k)
RB_MAIN(pixel, k.extent)
    store(result, pixel, fetch(source, pixel));
RB_END_KERNEL
