// SPDX-License-Identifier: MIT
// What a compiled plan consists of on the CPU.
#pragma once

#include "rebound/cpu/device.hpp"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace rebound::cpu {

struct Device::Shared {
    Isa isa = Isa::scalar;
    bool timings = false;
    std::unique_ptr<ThreadPool> pool; // null with the engine's own parallel-for
    ParallelFor parallelFor;
    std::vector<std::span<const KernelEntry* const>> kernels;

    const KernelEntry* findKernel(std::string_view name) const;
};

// Memory aligned to a cache line.
struct AlignedMemory {
    struct Free {
        void operator()(std::byte* p) const;
    };
    std::unique_ptr<std::byte[], Free> bytes;

    // Null where memory is short.
    static AlignedMemory allocate(size_t size);
};

struct CompiledPass {
    RunRows run = nullptr;
    std::array<Binding, slotCount> slots{}; // complete but for what the host hands in with each frame
    std::vector<PassBinding> external;      // bindings that record() completes
    std::vector<ResourceIndex>
        cleared; // transients that the pass writes: their padding is to be zero afterwards
    Extent2D grid;
    int rowsPerTask = 1;
};

struct Program::State {
    std::shared_ptr<const Device::Shared> device;
    Plan plan;
    MemoryUse use;
    AlignedMemory memory;           // transients, then buffers
    std::vector<Binding> resources; // by resource of the plan; those of the host without data
    std::vector<CompiledPass> passes;
    std::vector<PassTiming> timings;
    std::function<void(int)> passCallback;
};

inline constexpr size_t memoryAlignment = 64; // a cache line, and the widest vector [bytes]

// How a transient image lies in memory; data is the offset of its first float behind the image's start.
struct ImageLayout {
    ptrdiff_t rowStride = 0;     // [floats]
    ptrdiff_t channelStride = 0; // [floats]
    size_t size = 0;             // [bytes]
};
ImageLayout layoutOf(const Resource&);

} // namespace rebound::cpu
