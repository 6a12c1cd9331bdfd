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
    if (way == reachFour) {
        Vec4 four = loadFour(reals, index + Int(k.count.y));
        r = four.x + four.y * 2.0f + four.z * 4.0f + four.w * 8.0f;
    }
    if (way == reachFirst) {
        // The waterfall: lanes of one number are treated together, with uniform loads.
        Int group = (index * 5) & Int(3);
        Mask waiting = index < Int(k.count.x);
        while (anyLane(waiting)) {
            int chosen = firstLane(waiting, group);
            Mask here = waiting && group == Int(chosen);
            x = select(here, UInt(source[chosen]), x);
            r = select(here, Real(reals[chosen + 1]), r);
            waiting = waiting && !here;
        }
    }
    if (way == reachStoreFour) {
        storeItem(result, item, x);
        storeFour(realResult, item, index + Int(k.count.y), Vec4(r, r + 1.0f, r + 2.0f, r + 3.0f));
    } else if (way == reachStoreOffset) {
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
