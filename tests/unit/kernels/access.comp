// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// One way to read an image.
RB_KERNEL(Access)
RB_FEATURE(0, mode, accessCount)
RB_TEXTURE_OF_ANY_SIZE(0, source)
RB_INPUT(1, host)
RB_OUTPUT(2, rgba32f, result)
RB_CONSTANTS(3, AccessConstants, k)
RB_MAIN(pixel, k.extent)
    ivec2 offset = ivec2(k.offset.x, k.offset.y);
    Vec4 r = Vec4(0.0f);
    if (mode == accessFetch) r = fetchOffset(source, pixel, ivec2(0));
    if (mode == accessOffset) r = fetchOffset(source, pixel, offset);
    if (mode == accessMinified) r = fetchMinified(source, pixel, offset);
    if (mode == accessMagnified) r = fetchMagnified(source, pixel, ivec2(k.extent.w), k.extent.z, offset);
    Vec2 middle = pixelCenter(pixel);
    IVec2 at = IVec2(toInt(middle.x) * 3 + offset.x, toInt(middle.y) * 3 + offset.y);
    if (mode == accessAt) r = fetchAt(source, at);
    if (mode == accessHostAt) r = fetchAt(host, at);
    if (mode == accessReaches) {
        if (reaches(source, pixel, offset)) r = Vec4(1.0f);
    }
    if (mode == accessHost) r = fetch(host, pixel);
    if (mode == accessHostOffset) r = fetchOffset(host, pixel, offset);
    if (mode == accessHostMinified) r = fetchMinified(host, pixel, offset);
    if (mode == accessHostQuarter) r = fetchQuarter(host, pixel, offset);
    if (mode == accessCenter) r = Vec4(middle.x, middle.y, Real(0.0f), Real(0.0f));
    store(result, pixel, r);
RB_END_KERNEL
