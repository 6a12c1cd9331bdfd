// SPDX-License-Identifier: MIT
// The varying types Real, Int, UInt and Mask on a CPU: one lane, or as many as xsimd's batch for the instruction set that the
// including file is compiled for. Included inside that instruction set's namespace, after lanes_headers.h.

#ifdef REBOUND_SCALAR_LANES
using RealBatch = float;
using IntBatch = int32_t;
using UIntBatch = uint32_t;
using MaskBatch = bool;
inline constexpr int laneCount = 1;
#else
using RealBatch = xsimd::batch<float>;
using IntBatch = xsimd::batch<int32_t>;
using UIntBatch = xsimd::batch<uint32_t>;
using MaskBatch = xsimd::batch_bool<float>;
inline constexpr int laneCount = int(RealBatch::size);
#endif

// A truth value a lane. Not a bool: kernels choose with select().
struct Mask {
    MaskBatch batch;
#ifdef REBOUND_SCALAR_LANES
    friend Mask operator&&(Mask a, Mask b) { return {a.batch && b.batch}; }
    friend Mask operator||(Mask a, Mask b) { return {a.batch || b.batch}; }
    friend Mask operator!(Mask a) { return {!a.batch}; }
#else
    friend Mask operator&&(Mask a, Mask b) { return {a.batch & b.batch}; }
    friend Mask operator||(Mask a, Mask b) { return {a.batch | b.batch}; }
    friend Mask operator!(Mask a) { return {~a.batch}; }
#endif
};

struct Real {
    RealBatch batch;
    Real() = default;
    Real(float uniform) : batch(uniform) {}
#ifndef REBOUND_SCALAR_LANES
    Real(RealBatch b) : batch(b) {}
#endif
    friend Real operator+(Real a, Real b) { return {a.batch + b.batch}; }
    friend Real operator-(Real a, Real b) { return {a.batch - b.batch}; }
    friend Real operator*(Real a, Real b) { return {a.batch * b.batch}; }
    friend Real operator/(Real a, Real b) { return {a.batch / b.batch}; }
    friend Real operator-(Real a) { return {RealBatch(-0.0f) - a.batch}; } // xsimd's makes +0 of +0
    Real& operator+=(Real b) { return *this = *this + b; }
    Real& operator-=(Real b) { return *this = *this - b; }
    Real& operator*=(Real b) { return *this = *this * b; }
    Real& operator/=(Real b) { return *this = *this / b; }
    friend Mask operator<(Real a, Real b) { return {a.batch < b.batch}; }
    friend Mask operator>(Real a, Real b) { return {a.batch > b.batch}; }
    friend Mask operator<=(Real a, Real b) { return {a.batch <= b.batch}; }
    friend Mask operator>=(Real a, Real b) { return {a.batch >= b.batch}; }
    friend Mask operator==(Real a, Real b) { return {a.batch == b.batch}; }
};

struct Int {
    IntBatch batch;
    Int() = default;
    Int(int uniform) : batch(uniform) {}
#ifndef REBOUND_SCALAR_LANES
    Int(IntBatch b) : batch(b) {}
#endif
    friend Int operator+(Int a, Int b) { return {a.batch + b.batch}; }
    friend Int operator-(Int a, Int b) { return {a.batch - b.batch}; }
    friend Int operator*(Int a, Int b) { return {a.batch * b.batch}; }
    friend Int operator&(Int a, Int b) { return {a.batch & b.batch}; }
    friend Int operator|(Int a, Int b) { return {a.batch | b.batch}; }
    friend Int operator>>(Int a, int shift) { return {a.batch >> shift}; }
    friend Int operator<<(Int a, int shift) { return {a.batch << shift}; }
};

// 32 bits a lane: arithmetic modulo 2^32.
struct UInt {
    UIntBatch batch;
    UInt() = default;
    UInt(uint32_t uniform) : batch(uniform) {}
#ifndef REBOUND_SCALAR_LANES
    UInt(UIntBatch b) : batch(b) {}
#endif
    friend UInt operator+(UInt a, UInt b) { return {a.batch + b.batch}; }
    friend UInt operator-(UInt a, UInt b) { return {a.batch - b.batch}; }
    friend UInt operator*(UInt a, UInt b) { return {a.batch * b.batch}; }
    friend UInt operator&(UInt a, UInt b) { return {a.batch & b.batch}; }
    friend UInt operator|(UInt a, UInt b) { return {a.batch | b.batch}; }
    friend UInt operator^(UInt a, UInt b) { return {a.batch ^ b.batch}; }
    friend UInt operator~(UInt a) { return {~a.batch}; }
    friend UInt operator>>(UInt a, int shift) { return {a.batch >> shift}; }
    friend UInt operator<<(UInt a, int shift) { return {a.batch << shift}; }
    UInt& operator+=(UInt b) { return *this = *this + b; }
    UInt& operator^=(UInt b) { return *this = *this ^ b; }
};

// Moving bits between the types, and lanes to and from memory.
#ifdef REBOUND_SCALAR_LANES
inline Int toInt(UInt a) { return {int32_t(a.batch)}; }
inline UInt toUInt(Int a) { return {uint32_t(a.batch)}; }
inline Int loadLanes(const int32_t* p) { return {*p}; }
inline UInt loadLanes(const uint32_t* p) { return {*p}; }
inline void storeLanes(uint32_t* p, UInt a) { *p = a.batch; }
inline Int bitsOf(Real a) { return {__builtin_bit_cast(int32_t, a.batch)}; }
inline Real realOfBits(Int a) { return {__builtin_bit_cast(float, a.batch)}; }
inline Mask maskOf(bool m) { return {m}; }
inline Mask compareEqual(Int a, Int b) { return {a.batch == b.batch}; }
inline Mask compareLess(Int a, Int b) { return {a.batch < b.batch}; }
inline Real loadLanes(const float* p) { return {*p}; }
inline void storeLanes(float* p, Real a) { *p = a.batch; }
inline void storeLanes(int32_t* p, Int a) { *p = a.batch; }
inline Int laneIndex() { return {0}; }
#else
inline Int toInt(UInt a) { return {xsimd::bitwise_cast<IntBatch>(a.batch)}; }
inline UInt toUInt(Int a) { return {xsimd::bitwise_cast<UIntBatch>(a.batch)}; }
inline Int loadLanes(const int32_t* p) { return {IntBatch::load_unaligned(p)}; }
inline UInt loadLanes(const uint32_t* p) { return {UIntBatch::load_unaligned(p)}; }
inline void storeLanes(uint32_t* p, UInt a) { a.batch.store_unaligned(p); }
inline Int bitsOf(Real a) { return {xsimd::bitwise_cast<IntBatch>(a.batch)}; }
inline Real realOfBits(Int a) { return {xsimd::bitwise_cast<RealBatch>(a.batch)}; }
// xsimd 8.1 has no conversion between masks of int and of float lanes: go through the sign of the difference's bits.
inline Mask maskOfBits(Int allOnesOrZero) {
    return {xsimd::bitwise_cast<RealBatch>((allOnesOrZero.batch & IntBatch(0x3f800000))) > RealBatch(0.0f)};
}
inline Mask compareEqual(Int a, Int b) {
    return maskOfBits({xsimd::select(a.batch == b.batch, IntBatch(-1), IntBatch(0))});
}
inline Mask compareLess(Int a, Int b) {
    return maskOfBits({xsimd::select(a.batch < b.batch, IntBatch(-1), IntBatch(0))});
}
inline Real loadLanes(const float* p) { return {RealBatch::load_unaligned(p)}; }
inline void storeLanes(float* p, Real a) { a.batch.store_unaligned(p); }
inline void storeLanes(int32_t* p, Int a) { a.batch.store_unaligned(p); }
inline Int laneIndex() {
    alignas(64) static constexpr int32_t index[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    static_assert(laneCount <= 16);
    return {IntBatch::load_aligned(index)};
}
#endif
inline Mask operator==(Int a, Int b) { return compareEqual(a, b); }
inline Mask operator<(Int a, Int b) { return compareLess(a, b); }
inline Mask operator>(Int a, Int b) { return compareLess(b, a); }
inline Mask operator==(UInt a, UInt b) { return compareEqual(toInt(a), toInt(b)); }
inline Mask operator<(UInt a, UInt b) {
    const UInt top(0x80000000u); // with it flipped, order is that of signed integers
    return compareLess(toInt(a ^ top), toInt(b ^ top));
}
inline Mask operator>(UInt a, UInt b) { return b < a; }

// The functions of the kernel language on Real and Int.
#ifdef REBOUND_SCALAR_LANES
inline Real select(Mask m, Real a, Real b) { return m.batch ? a : b; }
inline Int select(Mask m, Int a, Int b) { return m.batch ? a : b; }
inline bool anyLane(Mask m) { return m.batch; }
inline Real min(Real a, Real b) { return b.batch < a.batch ? b : a; }
inline Real max(Real a, Real b) { return a.batch < b.batch ? b : a; }
inline Real abs(Real a) { return {__builtin_fabsf(a.batch)}; }
inline Real sqrt(Real a) { return {__builtin_sqrtf(a.batch)}; }
inline Real floor(Real a) { return {__builtin_floorf(a.batch)}; }
inline Real inverseSqrt(Real a) { return {1.0f / __builtin_sqrtf(a.batch)}; }
inline Real reciprocal(Real a) { return {1.0f / a.batch}; }
inline Real roughReciprocal(Real a) { return reciprocal(a); }
inline Real toReal(Int a) { return {float(a.batch)}; }
inline Int toInt(Real a) { return {int32_t(a.batch)}; }
#else
inline Real select(Mask m, Real a, Real b) { return {xsimd::select(m.batch, a.batch, b.batch)}; }
inline Int select(Mask m, Int a, Int b) { return bitsOf(select(m, realOfBits(a), realOfBits(b))); }
inline bool anyLane(Mask m) { return xsimd::any(m.batch); }
// In GLSL's order of operands: where a lane compares NaN, the first operand is the result. x86's instructions do the same
// with the second one.
#if defined(__SSE2__)
inline Real min(Real a, Real b) { return {xsimd::min(b.batch, a.batch)}; }
inline Real max(Real a, Real b) { return {xsimd::max(b.batch, a.batch)}; }
#else
inline Real min(Real a, Real b) { return select(b < a, b, a); }
inline Real max(Real a, Real b) { return select(a < b, b, a); }
#endif
inline Real abs(Real a) { return {xsimd::abs(a.batch)}; }
inline Real sqrt(Real a) { return {xsimd::sqrt(a.batch)}; }
inline Real floor(Real a) { return {xsimd::floor(a.batch)}; }
inline Real toReal(Int a) { return {xsimd::to_float(a.batch)}; }
inline Int toInt(Real a) { return {xsimd::to_int(a.batch)}; }
#endif
inline Real clamp(Real a, Real low, Real high) { return min(max(a, low), high); }
inline Real mix(Real a, Real b, Real t) { return a + (b - a) * t; }
inline Mask isFinite(Real a) { return abs(a) < Real(std::numeric_limits<float>::infinity()); }

inline UInt select(Mask m, UInt a, UInt b) { return toUInt(select(m, toInt(a), toInt(b))); }
inline UInt floatBitsToUint(Real a) { return toUInt(bitsOf(a)); }
inline Real uintBitsToFloat(UInt a) { return realOfBits(toInt(a)); }
// The nearest float. Both halves are exact, and so is the product: only the sum is rounded.
inline Real toReal(UInt a) {
    return toReal(toInt(a >> 16)) * Real(65536.0f) + toReal(toInt(a & UInt(0xffffu)));
}
// Towards zero, for 0 to 2^32, without 2^32.
inline UInt toUInt(Real a) {
    const Mask large = a >= Real(2147483648.0f);
    const UInt rest = toUInt(toInt(select(large, a - Real(2147483648.0f), a)));
    return rest | select(large, UInt(0x80000000u), UInt(0u));
}
inline Int bitCount(UInt a) {
    a = a - ((a >> 1) & UInt(0x55555555u));
    a = (a & UInt(0x33333333u)) + ((a >> 2) & UInt(0x33333333u));
    a = (a + (a >> 4)) & UInt(0x0f0f0f0fu);
    return toInt((a * UInt(0x01010101u)) >> 24);
}
