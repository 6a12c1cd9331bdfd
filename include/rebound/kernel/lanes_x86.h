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

inline Real reciprocal(Real a) {
#if defined(__AVX512F__)
    const Real estimate{RealBatch(_mm512_rcp14_ps(a.batch))};
#elif defined(__AVX2__)
    const Real estimate{RealBatch(_mm256_rcp_ps(a.batch))};
#elif defined(__SSE2__)
    const Real estimate{RealBatch(_mm_rcp_ps(a.batch))};
#else
    return Real(1.0f) / a;
#endif
#if defined(__SSE2__)
    return estimate * (Real(2.0f) - a * estimate);
#endif
}

// Lanes p[0], p[2], p[4], ...
inline Real loadEveryOther(const float* p) {
#if defined(__AVX512F__)
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    return {RealBatch(_mm512_permutex2var_ps(_mm512_loadu_ps(p), even, _mm512_loadu_ps(p + 16)))};
#elif defined(__AVX2__)
    const __m256 pairs =
        _mm256_shuffle_ps(_mm256_loadu_ps(p), _mm256_loadu_ps(p + 8), _MM_SHUFFLE(2, 0, 2, 0));
    return {
        RealBatch(_mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(pairs), _MM_SHUFFLE(3, 1, 2, 0))))};
#elif defined(__SSE2__)
    return {RealBatch(_mm_shuffle_ps(_mm_loadu_ps(p), _mm_loadu_ps(p + 4), _MM_SHUFFLE(2, 0, 2, 0)))};
#else
    alignas(64) float lanes[laneCount];
    for (int i = 0; i < laneCount; ++i) lanes[i] = p[2 * i];
    return loadLanes(lanes);
#endif
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

inline Real loadEveryOther(const float* p) { return {*p}; }
inline Real loadRepeated(const float* p, int bias, int shift) { return {p[bias >> shift]}; }
inline Real loadHalves(const uint16_t* p) { return {halfToFloat(*p)}; }
inline void storeHalves(uint16_t* p, Real a) { *p = floatToHalf(a.batch); }

#endif
