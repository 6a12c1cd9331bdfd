// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// Each item's sum over all frames of a weight that its key chooses.
RB_ITEM_KERNEL(SumItems)
RB_VALUES(0, uint, list)
RB_VALUES(1, float, weights)
RB_VALUES(2, float, before)
RB_OUTPUT_VALUES(3, float, after)
RB_CONSTANTS(4, SumConstants, k)
RB_ITEM_MAIN(item, k.extent.z)
    UInt key = loadItem(list, item);
    Real weight = loadAt(weights, toInt(key & UInt(15u)));
    storeItem(after, item, loadItem(before, item) + weight);
RB_END_KERNEL
