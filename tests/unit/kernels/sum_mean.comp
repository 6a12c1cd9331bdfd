// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "rebound/kernel/frame_state.h"
#include "test_constants.h"

// The mean over frames: where nothing went before, what is there.
RB_KERNEL(SumMean)
RB_INPUT(0, picture)
RB_TEXTURE(1, previous)
RB_UINT_TEXTURE(2, keys)
RB_VALUES(3, float, sums)
RB_IMAGE(4, rgba32f, mean)
RB_CONSTANTS(5, FrameState, frames)
RB_CONSTANTS(6, SumConstants, k)
RB_MAIN(pixel, k.extent)
    Real now = fetch(picture, pixel).x;
    Vec4 before = fetch(previous, pixel);
    float share = frames.history.x == 1 ? k.share.x : 1.0f;
    Real mixed = before.x * (1.0f - share) + now * share;
    UInt key = fetch(keys, pixel).x;
    Real sum = loadItem(sums, itemOf(pixel, k.extent.x));
    store(mean, pixel, Vec4(mixed, sum, toReal(key & UInt(1023u)), Real(float(frames.history.y))));
RB_END_KERNEL
