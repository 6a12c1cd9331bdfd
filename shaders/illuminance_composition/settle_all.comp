// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/illuminance_composition_constants.h"

// Whether no number is zero: 1, or 0.
RB_ITEM_KERNEL(SettleAll)
RB_VALUES(0, float, numbers)
RB_OUTPUT_VALUES(1, float, settled)
RB_CONSTANTS(2, SettleConstants, k)
RB_ITEM_MAIN(item, k.counts.x)
    float least = 1.0f;
    for (int i = 0; i < k.counts.y; ++i) least = min(least, numbers[i]);
    storeItem(settled, item, Real(least));
RB_END_KERNEL
