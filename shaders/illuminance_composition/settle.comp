// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/illuminance_composition_constants.h"

// Whether all of an item's numbers are zero: 1, or 0. They lie one number of items apart.
RB_ITEM_KERNEL(Settle)
RB_VALUES(0, float, numbers)
RB_OUTPUT_VALUES(1, float, areZero)
RB_CONSTANTS(2, SettleConstants, k)
RB_ITEM_MAIN(item, k.counts.x)
    Mask zero = indexOf(item) == indexOf(item);
    for (int i = 0; i < k.counts.y; ++i)
        zero = zero && loadOffset(numbers, item, k.counts.z + i * k.counts.x) == Real(0.0f);
    storeItem(areZero, item, select(zero, Real(1.0f), Real(0.0f)));
RB_END_KERNEL
