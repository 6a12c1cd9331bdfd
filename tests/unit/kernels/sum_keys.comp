// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// What pixels hold, as integers: in an image, and in a list.
RB_KERNEL(SumKeys)
RB_INPUT(0, picture)
RB_IMAGE(1, r32ui, keys)
RB_OUTPUT_VALUES(2, uint, list)
RB_CONSTANTS(3, SumConstants, k)
RB_MAIN(pixel, k.extent)
    UInt key = toUInt(fetch(picture, pixel).x) * UInt(2654435761u);
    key = key ^ (key >> 16);
    store(keys, pixel, UVec4(key, UInt(0u), UInt(0u), UInt(0u)));
    storeItem(list, itemOf(pixel, k.extent.x), key);
RB_END_KERNEL
