// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// Sums as they are for the next frame, and for the host.
RB_ITEM_KERNEL(SumKeep)
RB_FEATURE(0, reports, 2)
RB_FEATURE(1, doubles, 2)
RB_COMBINATIONS(reports == 1 || doubles == 0)
RB_VALUES(0, float, after)
RB_OUTPUT_VALUES(1, float, before)
RB_OUTPUT_VALUES(2, float, report)
RB_CONSTANTS(3, SumConstants, k)
RB_ITEM_MAIN(item, k.extent.z)
    Real sum = loadItem(after, item);
    storeItem(before, item, sum);
    if (reports == 1) {
        if (doubles == 1) sum = sum * 2.0f;
        storeItem(report, item, sum);
    }
RB_END_KERNEL
