// SPDX-License-Identifier: MIT
#include "lab/light/low_discrepancy.hpp"

namespace rebound::lab {

namespace {

uint32_t reverseBits(uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// The second dimension of Sobol's sequence from the first, which is the index with its bits reversed: its matrix is
// Pascal's triangle modulo 2, a product of five sparse ones (Ahmed: An Implementation Algorithm of 2D Sobol Sequence).
uint32_t secondDimension(uint32_t x) {
    x ^= x << 16;
    x ^= (x & 0x00ff00ffu) << 8;
    x ^= (x & 0x0f0f0f0fu) << 4;
    x ^= (x & 0x33333333u) << 2;
    return x ^ ((x & 0x55555555u) << 1);
}

uint32_t scramble(uint32_t x, uint32_t seed) {
    x = reverseBits(x);
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reverseBits(x);
}

// The 24 bits that a float holds, so that 1 is never reached.
float toUnitInterval(uint32_t x) { return float(x >> 8) * 0x1p-24f; }

} // namespace

uint32_t hashBits(uint32_t x) {
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    return x ^ (x >> 16);
}

uint32_t hashBits(uint32_t a, uint32_t b) { return hashBits(a ^ (hashBits(b + 0x9e3779b9u) * 0x01000193u)); }

glm::vec2 sobolPoint(uint32_t index, uint32_t seed) {
    const uint32_t first = reverseBits(index);
    return {toUnitInterval(scramble(first, hashBits(seed))),
            toUnitInterval(scramble(secondDimension(first), hashBits(seed + 1u)))};
}

glm::vec2 shuffledSobolPoint(uint32_t index, uint32_t seed) {
    return sobolPoint(scramble(index, hashBits(seed + 2u)), seed);
}

} // namespace rebound::lab
