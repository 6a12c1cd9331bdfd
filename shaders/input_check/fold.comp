// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/input_check_constants.h"

// Sums of sums, fewer.
RB_KERNEL(Fold)
RB_TEXTURE_OF_ANY_SIZE(0, from0)
RB_TEXTURE_OF_ANY_SIZE(1, from1)
RB_TEXTURE_OF_ANY_SIZE(2, from2)
RB_TEXTURE_OF_ANY_SIZE(3, from3)
RB_IMAGE(4, rgba32f, sums0)
RB_IMAGE(5, rgba32f, sums1)
RB_IMAGE(6, rgba32f, sums2)
RB_IMAGE(7, rgba32f, sums3)
RB_CONSTANTS(8, TileConstants, k)
RB_MAIN(pixel, k.grid)
    Vec4 s0 = Vec4(0.0f);
    Vec4 s1 = Vec4(0.0f);
    Vec4 s2 = Vec4(0.0f);
    Vec4 s3 = Vec4(0.0f);
    for (int j = 0; j < k.grid.w; ++j)
        for (int i = 0; i < k.grid.z; ++i) {
            ivec2 offset = ivec2(i * k.grid.x, j * k.grid.y);
            s0 += fetchOffset(from0, pixel, offset);
            s1 += fetchOffset(from1, pixel, offset);
            s2 += fetchOffset(from2, pixel, offset);
            s3 += fetchOffset(from3, pixel, offset);
        }
    store(sums0, pixel, s0);
    store(sums1, pixel, s1);
    store(sums2, pixel, s2);
    store(sums3, pixel, s3);
RB_END_KERNEL
