// SPDX-License-Identifier: MIT
// Lane operations that xsimd 8.1 lacks or gets wrong, by instruction set; with a portable form of each.
// Included by kernel_cpu.h inside the instruction set's namespace.

// Halves end at 65504; NaN stays.
inline Real withinHalves(Real a) { return min(max(a, Real(-65504.0f)), Real(65504.0f)); }

#ifndef REBOUND_SCALAR_LANES

// 1 / sqrt(a) and 1 / a for normal positive a, to a relative 5e-7: the processor's estimate, of 12 bits or 14, and one
// step of Newton's method.
inline Real inverseSqrt(Real a) {
#if defined(__AVX512F__)
    const Real estimate{RealBatch(_mm512_rsqrt14_ps(a.batch))};
#elif defined(__AVX2__)
    const Real estimate{RealBatch(_mm256_rsqrt_ps(a.batch))};
#elif defined(__SSE2__)
    const Real estimate{RealBatch(_mm_rsqrt_ps(a.batch))};
#else
    return Real(1.0f) / sqrt(a);
#endif
#if defined(__SSE2__)
    return estimate * (Real(1.5f) - Real(0.5f) * a * estimate * estimate);
#endif
}

// 1 / a for normal a, to a relative 4e-4: the processor's estimate.
inline Real roughReciprocal(Real a) {
#if defined(__AVX512F__)
    return {RealBatch(_mm512_rcp14_ps(a.batch))};
#elif defined(__AVX2__)
    return {RealBatch(_mm256_rcp_ps(a.batch))};
#elif defined(__SSE2__)
    return {RealBatch(_mm_rcp_ps(a.batch))};
#else
    return Real(1.0f) / a;
#endif
}

inline Real reciprocal(Real a) {
    const Real estimate = roughReciprocal(a);
#if defined(__SSE2__)
    return estimate * (Real(2.0f) - a * estimate);
#else
    return estimate;
#endif
}

// The value of the first lane where the mask is true; some lane is.
inline int firstLane(Mask m, Int a) {
    alignas(64) int32_t lanes[laneCount];
    storeLanes(lanes, a);
#if defined(__AVX512F__)
    return lanes[__builtin_ctz(m.batch.data)];
#elif defined(__AVX2__)
    return lanes[__builtin_ctz(unsigned(_mm256_movemask_ps(m.batch)))];
#elif defined(__SSE2__)
    return lanes[__builtin_ctz(unsigned(_mm_movemask_ps(m.batch)))];
#else
    alignas(64) int32_t chosen[laneCount];
    storeLanes(chosen, select(m, Int(1), Int(0)));
    int first = 0;
    while (first < laneCount - 1 && chosen[first] == 0) ++first;
    return lanes[first];
#endif
}

// Whether every lane is one of 0 to count - 1, count at least 1.
inline bool allBelow(Int a, int count) {
#if defined(__AVX512F__)
    return _mm512_cmpge_epu32_mask(a.batch, _mm512_set1_epi32(count)) == 0;
#else
    return !anyLane(a < Int(0) || !(a < Int(count)));
#endif
}

// Number index of count at p, of each lane; zero outside. 32 bits each, as bits; count is at least 1. The processor's gather
// takes a third to two thirds of the time of a loop, where there is one.
inline Int loadIndexed(const int32_t* p, Int index, int count) {
#if defined(__AVX512F__)
    const __mmask16 inside = _mm512_cmplt_epu32_mask(index.batch, _mm512_set1_epi32(count));
    return {IntBatch(_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), inside, index.batch, p, 4))};
#elif defined(__AVX2__)
    const __m256i last = _mm256_set1_epi32(count - 1);
    const __m256i inside = _mm256_cmpeq_epi32(_mm256_min_epu32(index.batch, last), index.batch);
    return {IntBatch(_mm256_mask_i32gather_epi32(_mm256_setzero_si256(), p, index.batch, inside, 4))};
#else
    alignas(64) int32_t at[laneCount];
    storeLanes(at, index);
    for (int i = 0; i < laneCount; ++i) at[i] = unsigned(at[i]) < unsigned(count) ? p[at[i]] : 0;
    return loadLanes(at);
#endif
}

// The four floats from p + 4 * index on, of each lane.
inline void loadFours(const float* p, Int index, Real (&v)[4]) {
    alignas(64) int32_t at[laneCount];
    storeLanes(at, index);
#if defined(__SSE2__)
    const auto four = [&](int lane) { return _mm_loadu_ps(p + 4 * ptrdiff_t(at[lane])); };
#if defined(__AVX512F__)
    const auto row = [&](int lane) {
        const __m512 first = _mm512_castps128_ps512(four(lane));
        const __m512 two = _mm512_insertf32x4(first, four(lane + 4), 1);
        return _mm512_insertf32x4(_mm512_insertf32x4(two, four(lane + 8), 2), four(lane + 12), 3);
    };
#define RB_PAIRS(half, a, b) _mm512_unpack##half##_ps(a, b)
#define RB_HALVES(choice, a, b) _mm512_shuffle_ps(a, b, choice)
#elif defined(__AVX2__)
    const auto row = [&](int lane) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(four(lane)), four(lane + 4), 1);
    };
#define RB_PAIRS(half, a, b) _mm256_unpack##half##_ps(a, b)
#define RB_HALVES(choice, a, b) _mm256_shuffle_ps(a, b, choice)
#else
    const auto row = four;
#define RB_PAIRS(half, a, b) _mm_unpack##half##_ps(a, b)
#define RB_HALVES(choice, a, b) _mm_shuffle_ps(a, b, choice)
#endif
    const auto r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
    const auto xy01 = RB_PAIRS(lo, r0, r1), xy23 = RB_PAIRS(lo, r2, r3);
    const auto zw01 = RB_PAIRS(hi, r0, r1), zw23 = RB_PAIRS(hi, r2, r3);
    v[0] = Real(RealBatch(RB_HALVES(0x44, xy01, xy23)));
    v[1] = Real(RealBatch(RB_HALVES(0xee, xy01, xy23)));
    v[2] = Real(RealBatch(RB_HALVES(0x44, zw01, zw23)));
    v[3] = Real(RealBatch(RB_HALVES(0xee, zw01, zw23)));
#undef RB_PAIRS
#undef RB_HALVES
#else
    for (int c = 0; c < 4; ++c) {
        alignas(64) float lanes[laneCount];
        for (int i = 0; i < laneCount; ++i) lanes[i] = p[4 * ptrdiff_t(at[i]) + c];
        v[c] = loadLanes(lanes);
    }
#endif
}

// Lanes odd, odd + 2, ... of two vectors, one behind the other; odd: 0 or 1.
inline Real everyOther(Real first, Real second, int odd) {
#if defined(__AVX512F__)
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i wanted = _mm512_add_epi32(even, _mm512_set1_epi32(odd));
    return {RealBatch(_mm512_permutex2var_ps(first.batch, wanted, second.batch))};
#elif defined(__AVX2__)
    const __m256 pairs = odd ? _mm256_shuffle_ps(first.batch, second.batch, _MM_SHUFFLE(3, 1, 3, 1))
                             : _mm256_shuffle_ps(first.batch, second.batch, _MM_SHUFFLE(2, 0, 2, 0));
    return {
        RealBatch(_mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(pairs), _MM_SHUFFLE(3, 1, 2, 0))))};
#elif defined(__SSE2__)
    return {RealBatch(odd ? _mm_shuffle_ps(first.batch, second.batch, _MM_SHUFFLE(3, 1, 3, 1))
                          : _mm_shuffle_ps(first.batch, second.batch, _MM_SHUFFLE(2, 0, 2, 0)))};
#else
    alignas(64) float lanes[2 * laneCount];
    storeLanes(lanes, first);
    storeLanes(lanes + laneCount, second);
    for (int i = 0; i < laneCount; ++i) lanes[i] = lanes[2 * i + odd];
    return loadLanes(lanes);
#endif
}

// Lanes p[first], p[first + 2], ... of 2 * laneCount that are read; first: 0 or 1.
inline Real loadEveryOther(const float* p, int first) {
    return everyOther(loadLanes(p), loadLanes(p + laneCount), first);
}

// Lanes p[first], p[first + 4], ... of 4 * laneCount that are read; first: 0 to 3.
inline Real loadEveryFourth(const float* p, int first) {
    return everyOther(loadEveryOther(p, first & 1), loadEveryOther(p + 2 * laneCount, first & 1), first >> 1);
}

// Lane i is p[(i + bias) >> shift], for 0 <= bias < 1 << shift.
inline Real loadRepeated(const float* p, int bias, int shift) {
#if defined(__AVX512F__)
    const __m512i index = _mm512_sra_epi32(_mm512_add_epi32(laneIndex().batch, _mm512_set1_epi32(bias)),
                                           _mm_cvtsi32_si128(shift));
    return {RealBatch(_mm512_permutexvar_ps(index, _mm512_loadu_ps(p)))};
#elif defined(__AVX2__)
    const __m256i index = _mm256_sra_epi32(_mm256_add_epi32(laneIndex().batch, _mm256_set1_epi32(bias)),
                                           _mm_cvtsi32_si128(shift));
    return {RealBatch(_mm256_permutevar8x32_ps(_mm256_loadu_ps(p), index))};
#else
    alignas(64) float lanes[laneCount];
    for (int i = 0; i < laneCount; ++i) lanes[i] = p[(i + bias) >> shift];
    return loadLanes(lanes);
#endif
}

// Lanes a[0], b[0], a[1], b[1], ...
inline Real loadInTurns(const float* a, const float* b) {
#if defined(__AVX512F__)
    const __m512i turns = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    return {RealBatch(_mm512_permutex2var_ps(_mm512_castps256_ps512(_mm256_loadu_ps(a)), turns,
                                             _mm512_castps256_ps512(_mm256_loadu_ps(b))))};
#elif defined(__AVX2__)
    const __m128 first = _mm_loadu_ps(a), second = _mm_loadu_ps(b);
    return {RealBatch(_mm256_set_m128(_mm_unpackhi_ps(first, second), _mm_unpacklo_ps(first, second)))};
#elif defined(__SSE2__)
    const __m128 first = _mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(a)));
    const __m128 second = _mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(b)));
    return {RealBatch(_mm_unpacklo_ps(first, second))};
#else
    alignas(64) float lanes[laneCount];
    for (int i = 0; i < laneCount; ++i) lanes[i] = (i & 1) != 0 ? b[i / 2] : a[i / 2];
    return loadLanes(lanes);
#endif
}

// Lanes 0, 2, 4, ... to a, the others to b.
inline void storeInTurns(float* a, float* b, Real v) {
#if defined(__AVX512F__)
    const __m512i apart = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15);
    const __m512 halves = _mm512_permutexvar_ps(apart, v.batch);
    _mm256_storeu_ps(a, _mm512_castps512_ps256(halves));
    _mm256_storeu_ps(b, _mm512_extractf32x8_ps(halves, 1));
#elif defined(__AVX2__)
    const __m256 halves = _mm256_permutevar8x32_ps(v.batch, _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7));
    _mm_storeu_ps(a, _mm256_castps256_ps128(halves));
    _mm_storeu_ps(b, _mm256_extractf128_ps(halves, 1));
#else
    alignas(64) float lanes[laneCount];
    storeLanes(lanes, v);
    for (int i = 0; i < laneCount; ++i) ((i & 1) != 0 ? b : a)[i / 2] = lanes[i];
#endif
}

// As loadRepeated of the values a[0], b[0], a[1], b[1], ...
inline Real loadRepeatedInTurns(const float* a, const float* b, int bias, int shift) {
#if defined(__AVX512F__)
    const __m512i place = _mm512_sra_epi32(_mm512_add_epi32(laneIndex().batch, _mm512_set1_epi32(bias)),
                                           _mm_cvtsi32_si128(shift));
    const __m512i half =
        _mm512_slli_epi32(place, 4); // of which permutex2var reads the bit of odd places alone
    return {RealBatch(_mm512_permutex2var_ps(
        _mm512_castps256_ps512(_mm256_loadu_ps(a)),
        _mm512_ternarylogic_epi32(_mm512_srli_epi32(place, 1), half, _mm512_set1_epi32(16), 0xf8),
        _mm512_castps256_ps512(_mm256_loadu_ps(b))))};
#elif defined(__AVX2__)
    const __m256i place = _mm256_sra_epi32(_mm256_add_epi32(laneIndex().batch, _mm256_set1_epi32(bias)),
                                           _mm_cvtsi32_si128(shift));
    return {RealBatch(_mm256_permutevar8x32_ps(loadInTurns(a, b).batch, place))};
#else
    alignas(64) float lanes[laneCount];
    for (int i = 0; i < laneCount; ++i) {
        const int place = (i + bias) >> shift;
        lanes[i] = (place & 1) != 0 ? b[place / 2] : a[place / 2];
    }
    return loadLanes(lanes);
#endif
}

// laneCount half floats.
inline Real loadHalves(const uint16_t* p) {
#if defined(__AVX512F__)
    return {RealBatch(_mm512_cvtph_ps(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))))};
#elif defined(__F16C__)
    return {RealBatch(_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))))};
#else
    alignas(64) float lanes[laneCount];
    for (int i = 0; i < laneCount; ++i) lanes[i] = halfToFloat(p[i]);
    return loadLanes(lanes);
#endif
}
// As loadEveryOther and loadEveryFourth, of half floats.
inline Real loadEveryOtherHalf(const uint16_t* p, int first) {
#if defined(__AVX512F__)
    const __m512i pairs = _mm512_loadu_si512(p);
    return {RealBatch(_mm512_cvtph_ps(_mm512_cvtepi32_epi16(first ? _mm512_srli_epi32(pairs, 16) : pairs)))};
#elif defined(__F16C__)
    const __m256i pairs = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    const __m256i wanted =
        first ? _mm256_srli_epi32(pairs, 16) : _mm256_and_si256(pairs, _mm256_set1_epi32(0xffff));
    const __m256i packed =
        _mm256_permute4x64_epi64(_mm256_packus_epi32(wanted, wanted), _MM_SHUFFLE(3, 1, 2, 0));
    return {RealBatch(_mm256_cvtph_ps(_mm256_castsi256_si128(packed)))};
#else
    alignas(64) float lanes[laneCount];
    for (int i = 0; i < laneCount; ++i) lanes[i] = halfToFloat(p[2 * i + first]);
    return loadLanes(lanes);
#endif
}
inline Real loadEveryFourthHalf(const uint16_t* p, int first) {
#if defined(__AVX512F__)
    const __m512i places = _mm512_broadcast_i32x8(_mm256_setr_epi32(
        0x00040000, 0x000c0008, 0x00140010, 0x001c0018, 0x00240020, 0x002c0028, 0x00340030, 0x003c0038));
    const __m512i wanted = _mm512_add_epi16(places, _mm512_set1_epi16(short(first)));
    const __m512i halves =
        _mm512_permutex2var_epi16(_mm512_loadu_si512(p), wanted, _mm512_loadu_si512(p + 2 * laneCount));
    return {RealBatch(_mm512_cvtph_ps(_mm512_castsi512_si256(halves)))};
#else
    return everyOther(loadEveryOtherHalf(p, first & 1), loadEveryOtherHalf(p + 2 * laneCount, first & 1),
                      first >> 1);
#endif
}
inline void storeHalves(uint16_t* p, Real a) {
#if defined(__AVX512F__)
    _mm256_storeu_si256(
        reinterpret_cast<__m256i*>(p),
        _mm512_cvtps_ph(withinHalves(a).batch, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
#elif defined(__F16C__)
    _mm_storeu_si128(reinterpret_cast<__m128i*>(p),
                     _mm256_cvtps_ph(withinHalves(a).batch, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
#else
    alignas(64) float lanes[laneCount];
    storeLanes(lanes, a);
    for (int i = 0; i < laneCount; ++i) p[i] = floatToHalf(lanes[i]);
#endif
}

#else

inline int firstLane(Mask, Int a) { return a.batch; }
inline Int loadIndexed(const int32_t* p, Int index, int count) {
    return {unsigned(index.batch) < unsigned(count) ? p[index.batch] : 0};
}
inline bool allBelow(Int a, int count) { return unsigned(a.batch) < unsigned(count); }
inline void loadFours(const float* p, Int index, Real (&v)[4]) {
    for (int c = 0; c < 4; ++c) v[c] = Real(p[4 * ptrdiff_t(index.batch) + c]);
}
inline Real loadEveryOther(const float* p, int first) { return {p[first]}; }
inline Real loadEveryFourth(const float* p, int first) { return {p[first]}; }
inline Real loadRepeated(const float* p, int bias, int shift) { return {p[bias >> shift]}; }
inline Real loadInTurns(const float* a, const float*) { return {*a}; }
inline void storeInTurns(float* a, float*, Real v) { *a = v.batch; }
inline Real loadRepeatedInTurns(const float* a, const float*, int bias, int shift) {
    return {a[bias >> shift]};
}
inline Real loadHalves(const uint16_t* p) { return {halfToFloat(*p)}; }
inline Real loadEveryOtherHalf(const uint16_t* p, int first) { return {halfToFloat(p[first])}; }
inline Real loadEveryFourthHalf(const uint16_t* p, int first) { return {halfToFloat(p[first])}; }
inline void storeHalves(uint16_t* p, Real a) { *p = floatToHalf(a.batch); }

#endif
