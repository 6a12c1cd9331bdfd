// SPDX-License-Identifier: MIT
// Low-discrepancy points and hashes, the same on every machine and in every thread.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace rebound::lab {

// Mixes all bits (the finalizer of MurmurHash3).
uint32_t hashBits(uint32_t);

// A well mixed combination of both.
uint32_t hashBits(uint32_t a, uint32_t b);

// Point `index` of the (0,2)-sequence of Sobol in [0, 1)^2 under nested uniform scrambling, chosen by the
// seed: the first 2^k points hit every stratum of 2^-k once. Laine, Karras: Stratified Sampling for
// Stochastic Transparency; Burley: Practical Hash-based Owen Scrambling.
glm::vec2 sobolPoint(uint32_t index, uint32_t seed);

// The same points in an order that the seed shuffles, such that the first 2^k are still a set with that property:
// sequences of different seeds can be taken together as further dimensions.
glm::vec2 shuffledSobolPoint(uint32_t index, uint32_t seed);

} // namespace rebound::lab
