// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// One way to reach a buffer's elements, of items.
RB_ITEM_KERNEL(Numbers)
RB_FEATURE(0, way, reachCount)
RB_VALUES(0, uint, source)
RB_VALUES(1, float, reals)
RB_OUTPUT_VALUES(2, uint, result)
RB_OUTPUT_VALUES(3, float, realResult)
RB_CONSTANTS(4, ItemConstants, k)
RB_ITEM_MAIN(item, k.count.x)
    UInt x = loadItem(source, item);
    Real r = loadItem(reals, item);
    Int index = indexOf(item);
    if (way == reachOffset) {
        x = loadOffset(source, item, k.count.y);
        r = loadOffset(reals, item, k.count.y);
    }
    if (way == reachAt) {
        x = loadAt(source, index * 3 + Int(k.count.y));
        r = loadAt(reals, index * 3 + Int(k.count.y));
    }
    if (way == reachUniform) {
        x = UInt(source[k.count.y]);
        r = Real(reals[k.count.y]);
    }
    if (way == reachStoreOffset) {
        storeOffset(result, item, k.count.y, x);
        storeOffset(realResult, item, k.count.y, r);
    } else if (way == reachStoreAt) {
        storeAt(result, item, index * 3 + Int(k.count.y), x);
        storeAt(realResult, item, index * 3 + Int(k.count.y), r);
    } else {
        storeItem(result, item, x);
        storeItem(realResult, item, r);
    }
RB_END_KERNEL
