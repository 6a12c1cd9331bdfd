// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/techniques/input_check_constants.h"

// All rows below each other.
RB_KERNEL(Table)
RB_TEXTURE_OF_ANY_SIZE(0, row0)
RB_TEXTURE_OF_ANY_SIZE(1, row1)
RB_TEXTURE_OF_ANY_SIZE(2, row2)
RB_TEXTURE_OF_ANY_SIZE(3, row3)
RB_TEXTURE_OF_ANY_SIZE(4, row4)
RB_TEXTURE_OF_ANY_SIZE(5, row5)
RB_TEXTURE_OF_ANY_SIZE(6, row6)
RB_TEXTURE_OF_ANY_SIZE(7, row7)
RB_TEXTURE_OF_ANY_SIZE(8, row8)
RB_TEXTURE_OF_ANY_SIZE(9, row9)
RB_TEXTURE_OF_ANY_SIZE(10, row10)
RB_OUTPUT(11, rgba32f, statistics)
RB_CONSTANTS(12, TileConstants, k)
RB_MAIN(pixel, k.grid)
    Vec2 center = pixelCenter(pixel);
    IVec2 at = IVec2(toInt(center.x), Int(0));
    Real y = center.y;
    Vec4 v = fetchAt(row0, at);
    v = select(y > 1.0f, fetchAt(row1, at), v);
    v = select(y > 2.0f, fetchAt(row2, at), v);
    v = select(y > 3.0f, fetchAt(row3, at), v);
    v = select(y > 4.0f, fetchAt(row4, at), v);
    v = select(y > 5.0f, fetchAt(row5, at), v);
    v = select(y > 6.0f, fetchAt(row6, at), v);
    v = select(y > 7.0f, fetchAt(row7, at), v);
    v = select(y > 8.0f, fetchAt(row8, at), v);
    v = select(y > 9.0f, fetchAt(row9, at), v);
    v = select(y > 10.0f, fetchAt(row10, at), v);
    store(statistics, pixel, v);
RB_END_KERNEL
