// SPDX-License-Identifier: MIT
#include "rebound/kernel/kernel.h"
#include "test_constants.h"

// One operation of the language on three operands a pixel.
RB_KERNEL(Arithmetic)
RB_FEATURE(0, operation, opCount)
RB_INPUT(0, first)
RB_INPUT(1, second)
RB_INPUT(2, third)
RB_OUTPUT(3, rgba32f, result)
RB_CONSTANTS(4, GridConstants, k)
RB_MAIN(pixel, k.extent)
    Vec4 a = fetch(first, pixel);
    Vec4 b = fetch(second, pixel);
    Vec4 c = fetch(third, pixel);
    Real x = a.x;
    Real y = b.x;
    Real z = c.x;
    Real one = Real(1.0f);
    Real zero = Real(0.0f);
    Vec4 r = Vec4(0.0f);
    if (operation == opAdd) r.x = x + y;
    if (operation == opSubtract) r.x = x - y;
    if (operation == opMultiply) r.x = x * y;
    if (operation == opDivide) r.x = x / y;
    if (operation == opNegate) r.x = -x;
    if (operation == opAddTo) { r.x = x; r.x += y; }
    if (operation == opSubtractFrom) { r.x = x; r.x -= y; }
    if (operation == opMultiplyBy) { r.x = x; r.x *= y; }
    if (operation == opDivideBy) { r.x = x; r.x /= y; }
    if (operation == opLess) r.x = select(x < y, one, zero);
    if (operation == opGreater) r.x = select(x > y, one, zero);
    if (operation == opLessEqual) r.x = select(x <= y, one, zero);
    if (operation == opGreaterEqual) r.x = select(x >= y, one, zero);
    if (operation == opEqual) r.x = select(x == y, one, zero);
    if (operation == opAnd) r.x = select(x < y && x < z, one, zero);
    if (operation == opOr) r.x = select(x < y || x < z, one, zero);
    if (operation == opNot) r.x = select(!(x < y), one, zero);
    if (operation == opMin) r.x = min(x, y);
    if (operation == opMax) r.x = max(x, y);
    if (operation == opAbs) r.x = abs(x);
    if (operation == opSqrt) r.x = sqrt(x);
    if (operation == opFloor) r.x = floor(x);
    if (operation == opClamp) r.x = clamp(x, Real(-2.0f), Real(100.0f));
    if (operation == opIsFinite) r.x = select(isFinite(x), one, zero);
    if (operation == opSelect) r.x = select(z > 0.0f, x, y);
    if (operation == opInverseSqrt) r.x = inverseSqrt(x);
    if (operation == opReciprocal) r.x = reciprocal(x);
    if (operation == opRoughReciprocal) r.x = roughReciprocal(x);
    if (operation == opMix) r.x = mix(x, y, z);
    if (operation == opIntAdd) r.x = toReal(toInt(x) + toInt(y));
    if (operation == opIntSubtract) r.x = toReal(toInt(x) - toInt(y));
    if (operation == opIntMultiply) r.x = toReal(toInt(x) * toInt(y));
    if (operation == opIntAnd) r.x = toReal(toInt(x) & toInt(y));
    if (operation == opIntOr) r.x = toReal(toInt(x) | toInt(y));
    if (operation == opIntShiftRight) r.x = toReal(toInt(x) >> 3);
    if (operation == opIntShiftLeft) r.x = toReal(toInt(x) << 3);
    if (operation == opIntEqual) r.x = select(toInt(x) == toInt(y), one, zero);
    if (operation == opIntLess) r.x = select(toInt(x) < toInt(y), one, zero);
    if (operation == opIntGreater) r.x = select(toInt(x) > toInt(y), one, zero);
    if (operation == opIntSelect) r.x = toReal(select(z > 0.0f, toInt(x), toInt(y)));
    if (operation == opRoundTrip) r.x = toReal(toInt(x));
    if (operation == opVectors) {
        Vec3 u = Vec3(a.x, a.y, a.z);
        Vec3 v = Vec3(b.x, b.y, b.z);
        Vec3 w = cross(u, v) + min(u, v) * 2.0f + max(u, 0.25f) + varying(vec3(1.0f, 2.0f, 3.0f));
        r = Vec4(w.x, w.y, w.z, dot(u, v) + dot(Vec2(a.x, a.y), Vec2(b.x, b.y)) + length(u));
    }
    if (operation == opVectorSelect) {
        Vec3 s = select(c.x > 0.0f, Vec3(a.x, a.y, a.z), Vec3(b.x, b.y, b.z));
        Vec2 t = select(c.y > 0.0f, Vec2(a.w, a.x), Vec2(b.w, b.x));
        Vec4 q = select(c.z > 0.0f, a, b);
        r = Vec4(s.y, t.x, t.y, q.w);
    }
    store(result, pixel, r);
RB_END_KERNEL
