// SPDX-License-Identifier: MIT
#include "planted_leak.hpp"

namespace rebound::cpu::avx2 {
float plantedUse(const float* values, int count) { return plantedLeak(values, count); }
} // namespace rebound::cpu::avx2
