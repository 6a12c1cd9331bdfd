// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/input_check_constants.h"

// The sum of each of four images, side by side.
RB_KERNEL(Total)
RB_TEXTURE_OF_ANY_SIZE(0, from0)
RB_TEXTURE_OF_ANY_SIZE(1, from1)
RB_TEXTURE_OF_ANY_SIZE(2, from2)
RB_TEXTURE_OF_ANY_SIZE(3, from3)
RB_IMAGE(4, rgba32f, row)
RB_CONSTANTS(5, TileConstants, k)
RB_MAIN(pixel, k.grid)
    Vec4 s0 = Vec4(0.0f);
    Vec4 s1 = Vec4(0.0f);
    Vec4 s2 = Vec4(0.0f);
    Vec4 s3 = Vec4(0.0f);
    for (int j = 0; j < k.grid.w; ++j)
        for (int i = 0; i < k.grid.z; ++i) {
            IVec2 at = IVec2(Int(i), Int(j));
            s0 += fetchAt(from0, at);
            s1 += fetchAt(from1, at);
            s2 += fetchAt(from2, at);
            s3 += fetchAt(from3, at);
        }
    Real x = pixelCenter(pixel).x;
    store(row, pixel, select(x < 1.0f, s0, select(x < 2.0f, s1, select(x < 3.0f, s2, s3))));
RB_END_KERNEL
