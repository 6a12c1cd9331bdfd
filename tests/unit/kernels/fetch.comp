// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// One of the device's own images as the host's.
RB_KERNEL(Fetch)
RB_TEXTURE(0, source)
RB_OUTPUT(1, rgba32f, result)
RB_CONSTANTS(2, GridConstants, k)
RB_MAIN(pixel, k.extent)
    store(result, pixel, fetch(source, pixel));
RB_END_KERNEL
