// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// Reads and writes by columns of one parity; marks each texel with its own column and row.
RB_KERNEL(Sparse)
RB_FEATURE(0, mode, sparseModeCount)
RB_SPARSE_TEXTURE(0, source)
RB_IMAGE(1, rgba32f, result)
RB_CONSTANTS(2, AccessConstants, k)
RB_MAIN(pixel, k.extent)
    ivec2 offset = ivec2(k.offset.x, k.offset.y);
    for (int turn = 0; turn < sparseCount(pixel, k.extent.x); ++turn) {
        SparsePixel at = sparsePixel(pixel, turn);
        Vec4 r = Vec4(0.0f);
        if (mode == sparseFetch) r = fetch(source, at);
        if (mode == sparseOffset) r = fetchOffset(source, at, offset);
        if (mode == sparseReaches) {
            if (reaches(source, at, offset)) r = fetchOffset(source, at, offset);
        }
        if (mode == sparsePlace) {
            Vec2 center = pixelCenter(at);
            r = Vec4(center.x, center.y, Real(float(columnOf(at) & 1)), Real(float(rowOf(at))));
        }
        store(result, at, r);
    }
RB_END_KERNEL
