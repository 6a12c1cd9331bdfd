// SPDX-License-Identifier: MIT
#include "rebound/cpu/kernels.hpp"

#include <string>

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#include <cpuid.h>
#endif

namespace rebound::cpu {
namespace {

constexpr Isa everyIsa[] = {Isa::scalar, Isa::baseline, Isa::avx2, Isa::avx512};

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
// Clang 14's __builtin_cpu_supports does not know F16C. Its registers are AVX's, whose support implies the system's.
bool hasF16c() {
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
#endif

// Whether processor and operating system support the instructions.
bool processorRuns(Isa isa) {
    switch (isa) {
    case Isa::automatic:
    case Isa::scalar:
    case Isa::baseline:
        return true;
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
    case Isa::avx2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && hasF16c();
    case Isa::avx512:
        return processorRuns(Isa::avx2) && __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
#else
    case Isa::avx2:
    case Isa::avx512:
        return false;
#endif
    }
    return false;
}

} // namespace

const char* name(Isa isa) {
    switch (isa) {
    case Isa::automatic:
        return "automatic";
    case Isa::scalar:
        return "scalar";
    case Isa::baseline:
        return "baseline";
    case Isa::avx2:
        return "avx2";
    case Isa::avx512:
        return "avx512";
    }
    return "?";
}

Result<Isa> isaFromName(std::string_view wanted) {
    if (wanted == name(Isa::automatic)) return Isa::automatic;
    std::string known = name(Isa::automatic);
    for (Isa isa : everyIsa) {
        if (wanted == name(isa)) return isa;
        known += std::string(", ") + name(isa);
    }
    return invalidArgument("isa is \"" + std::string(wanted) + "\"; one of " + known + " was expected");
}

bool isAvailable(Isa isa) {
    return isa == Isa::automatic || (processorRuns(isa) && !techniqueKernels(isa).empty());
}

std::vector<Isa> availableIsas() {
    std::vector<Isa> available;
    for (Isa isa : everyIsa)
        if (isAvailable(isa)) available.push_back(isa);
    return available;
}

} // namespace rebound::cpu
