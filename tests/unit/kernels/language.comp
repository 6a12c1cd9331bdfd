// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// Features, a table, constants, and a loop that lanes leave at different times: the number of steps that Collatz's
// sequence takes to reach 1.
RB_KERNEL(Language)
RB_FEATURE(0, units, 2)
RB_FEATURE(1, tens, 3)
RB_FEATURE(2, hundreds, 2)
RB_FEATURE(3, thousands, 4)
RB_INPUT(0, start)
RB_OUTPUT(1, rgba32f, result)
RB_CONSTANTS(2, LanguageConstants, k)
RB_BUFFER(3, TableEntry, entries)
RB_MAIN(pixel, k.extent)
    Int n = toInt(fetch(start, pixel).x);
    Int steps = Int(0);
    Mask going = n > Int(1);
    while (anyLane(going)) {
        Mask odd = (n & Int(1)) == Int(1);
        Int next = select(odd, n * 3 + 1, n >> 1);
        n = select(going, next, n);
        steps = steps + select(going, Int(1), Int(0));
        going = n > Int(1);
    }
    float sum = k.values.y;
    for (int i = 0; i < k.extent.z; ++i) {
        sum += entries[i].value.z * entries[i].weight + float(entries[i].index.y);
    }
    store(result, pixel,
          Vec4(toReal(steps), Real(float(units + 10 * tens + 100 * hundreds + 1000 * thousands)), Real(sum),
               Real(k.values.w)));
RB_END_KERNEL
