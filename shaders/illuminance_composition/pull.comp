// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/illuminance_composition_constants.h"

// What the nodes of a stage send: the sum over nodes of earlier ones.      [Jendersie, Kuri, Grosch, fig. 2, step 3]
RB_ITEM_KERNEL(Pull)
RB_FEATURE(0, skips, 2)
RB_VALUES(0, uint, terms)
RB_VALUES(1, float, nodes)
RB_OUTPUT_VALUES(2, float, sums)             // the same buffer: other nodes
RB_CONSTANTS(3, PullConstants, k)
RB_VALUES(4, float, settled)                 // 1: surfels sent the same in the frame before
RB_ITEM_MAIN(item, k.counts.x)
    if (skips == skippedIfSettled) {
        if (settled[0] != 0.0f) return;
    }
    Vec4 sum = Vec4(0.0f);
    for (int term = 0; term < k.terms.x; ++term) {
        sum += loadFour(nodes, toInt(loadOffset(terms, item, k.counts.w + term * k.counts.y)));
    }
    storeFour(sums, item, indexOf(item) + Int(k.counts.z), sum);
RB_END_KERNEL
