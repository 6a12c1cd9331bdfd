// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/math/spherical_harmonics.h"
#include "test_constants.h"

// The sixteen harmonics of each direction, one kind behind the other, or the coefficients of its lobe.
RB_ITEM_KERNEL(HarmonicsOfDirections)
RB_FEATURE(0, mode, harmonicsModeCount)
RB_VALUES(0, float, directions)
RB_OUTPUT_VALUES(1, float, result)
RB_CONSTANTS(2, ItemConstants, k)
RB_ITEM_MAIN(item, k.count.x)
    int stride = k.count.y;
    Vec3 d = Vec3(loadItem(directions, item), loadOffset(directions, item, stride),
                  loadOffset(directions, item, 2 * stride));
    Harmonics h;
    if (mode == harmonicsAlone) h = sphericalHarmonics(d);
    else h = lobe(d, loadOffset(directions, item, 3 * stride));
    for (int i = 0; i < maximumHarmonics; ++i) storeOffset(result, item, i * stride, h.value[i]);
RB_END_KERNEL
