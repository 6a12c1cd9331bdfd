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
    RunRange run = nullptr;
    std::array<Binding, slotCount> slots{}; // complete but for what changes from frame to frame
    std::vector<PassBinding> perFrame;      // bindings that record() completes: of the host, and of history
    std::vector<ResourceIndex>
        cleared; // images of the device's own that the pass writes: their padding is to be zero afterwards
    int widthOrItems = 0;
    int count = 0;        // of rows or items
    int countPerTask = 1; // likewise; of items a multiple of 64
};

struct Program::State {
    std::shared_ptr<const Device::Shared> device;
    Plan plan;
    MemoryUse use;
    AlignedMemory memory;            // transients, then buffers, then history and persistent buffers
    std::byte* persistent = nullptr; // the first byte of the latter
    detail::FrameCount frames;
    int historyWritten = 0; // the image of history that the latest frame has written
    std::vector<Binding>
        resources; // by resource of the plan; those of the host without data; of history the first image
    std::vector<size_t> historyDistance; // by resource: from the first image of history to the second [bytes]
    std::vector<CompiledPass> passes;
    std::vector<PassTiming> timings;
    std::function<void(int)> passCallback;
};

inline constexpr size_t memoryAlignment = 64; // a cache line, and the widest vector [bytes]

// How an image of the device's own lies in memory; data is the offset of its first float behind the image's start.
struct ImageLayout {
    ptrdiff_t rowStride = 0;     // [floats]
    ptrdiff_t channelStride = 0; // [floats]
    ptrdiff_t oddColumns = 0;    // as a Binding's [floats]
    size_t size = 0;             // [bytes]
};

} // namespace rebound::cpu
