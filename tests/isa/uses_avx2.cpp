// SPDX-License-Identifier: MIT
#include <cstdio>
#include <immintrin.h>

int main() {
    volatile int first = 1;
    const __m256i sums =
        _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    alignas(32) int lanes[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(lanes), sums);
    int sum = 0;
    for (int lane : lanes) sum += lane;
    std::printf("sum %d\n", sum);
}
