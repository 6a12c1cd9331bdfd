// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// One operation on unsigned integers.
RB_KERNEL(Integers)
RB_FEATURE(0, operation, uintOpCount)
RB_UINT_INPUT(0, first)
RB_UINT_TEXTURE(1, second)
RB_OUTPUT(2, rgba32ui, result)
RB_CONSTANTS(3, GridConstants, k)
RB_MAIN(pixel, k.extent)
    UVec4 a = fetch(first, pixel);
    UVec4 b = fetch(second, pixel);
    UInt x = a.x;
    UInt y = b.x;
    UInt one = UInt(1u);
    UInt zero = UInt(0u);
    UInt r = zero;
    if (operation == uintAdd) r = x + y;
    if (operation == uintSubtract) r = x - y;
    if (operation == uintMultiply) r = x * y;
    if (operation == uintAnd) r = x & y;
    if (operation == uintOr) r = x | y;
    if (operation == uintXor) r = x ^ y;
    if (operation == uintNot) r = ~x;
    if (operation == uintShiftRight) r = x >> 5;
    if (operation == uintShiftLeft) r = x << 5;
    if (operation == uintLess) r = select(x < y, one, zero);
    if (operation == uintGreater) r = select(x > y, one, zero);
    if (operation == uintEqual) r = select(x == y, one, zero);
    if (operation == uintSelect) r = select(x < y, x, y);
    if (operation == uintToReal) r = floatBitsToUint(toReal(x));
    if (operation == uintFromReal) r = toUInt(toReal(x >> 1));
    if (operation == uintFloatBits) r = floatBitsToUint(uintBitsToFloat(x & UInt(0x7f7fffffu)));
    if (operation == uintBitCount) r = toUInt(bitCount(x));
    if (operation == uintToInt) r = toUInt(toInt(x) + Int(-1));
    if (operation == uintFromInt) r = toUInt(toInt(x) >> 3);
    if (operation == uintOffset) {
        UVec4 left = fetchOffset(first, pixel, ivec2(-1, 0));
        UVec4 below = fetchOffset(second, pixel, ivec2(0, 1));
        r = left.y ^ below.z;
    }
    if (operation == uintAddTo) { r = x; r += y; r ^= one; }
    store(result, pixel, UVec4(r, b.y, a.z, x));
RB_END_KERNEL
