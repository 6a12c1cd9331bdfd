// SPDX-License-Identifier: MIT
// Instruction sets, and the kernels that were compiled for each.
#pragma once

#include "rebound/kernel/cpu_binding.h"
#include "rebound/result.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace rebound::cpu {

enum class Isa {
    automatic, // the best that this processor runs
    scalar,    // one pixel at a time: the yardstick of all backends
    baseline,  // what every processor of the family has: SSE2 on x86-64, NEON on 64-bit Arm
    avx2,      // AVX2, FMA and F16C
    avx512,    // AVX-512 F, CD, DQ, BW and VL
};

const char* name(Isa);

// The instruction set of that name; an unknown name's error lists those that exist.
Result<Isa> isaFromName(std::string_view);

// Whether kernels were compiled for it and this processor runs it.
bool isAvailable(Isa);

// Those that are available, slowest first; never empty.
std::vector<Isa> availableIsas();

// The kernels of the techniques for one instruction set; empty where none were compiled.
std::span<const KernelEntry* const> techniqueKernels(Isa);

} // namespace rebound::cpu
