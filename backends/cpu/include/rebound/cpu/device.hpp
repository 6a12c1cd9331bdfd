// SPDX-License-Identifier: MIT
// The CPU backend: runs plans on the host's processor, with the instruction set that it has.
#pragma once

#include "rebound/cpu/kernels.hpp"
#include "rebound/cpu/parallel_for.hpp"
#include "rebound/device.hpp"

#include <memory>
#include <span>

namespace rebound::cpu {

enum class Scalar { float32, float16 };

// An image of the host, in any regular layout: interleaved or a plane a channel. Fastest: a plane a channel.
// The host keeps it alive during record(), and no output may overlap any other image of the frame.
struct Image {
    void* data = nullptr; // pixel 0, 0 of channel 0
    Extent2D extent;
    int channels = 0; // 1 to 4; at least as many as the plan's resource has in use
    Scalar scalar = Scalar::float32;
    ptrdiff_t pixelStride = 0;   // from one pixel to its right neighbour [bytes]
    ptrdiff_t rowStride = 0;     // from one row to the next [bytes]
    ptrdiff_t channelStride = 0; // from one channel to the next [bytes]
};

// Tightly packed images.
Image interleavedImage(void* data, Extent2D, int channels, Scalar = Scalar::float32);
Image planarImage(void* data, Extent2D, int channels, Scalar = Scalar::float32);

struct DeviceOptions {
    Isa isa = Isa::automatic;
    int threads = 0; // of the device's own pool, 1 to 1024; 0: one a core. Ignored where parallelFor is set
    ParallelFor parallelFor; // the engine's own; empty: the device's pool
    bool timings = false;    // whether record() measures its passes
    // Kernels beside the techniques' own, of an engine that writes some; looked up first.
    std::vector<std::span<const KernelEntry* const> (*)(Isa)> moreKernels;
};

class Program;

class Device {
public:
    // Fails where the instruction set is not available or threads is out of range.
    static Result<Device> create(const DeviceOptions& = {});

    // Fails with an error where the plan is not valid, names a kernel, slot or feature that does not exist, or memory
    // is short; the device stays as it was.
    Result<Program> compile(const Plan&) const;

    // What compile() would allocate: 32-bit floats a channel in use, rows padded. Zero where the plan is not valid.
    MemoryUse memoryUse(const Plan&) const;

    Isa isa() const;
    int threads() const; // of the device's pool; 0 with the engine's own parallel-for

    struct Shared;

private:
    std::shared_ptr<const Shared> shared;
};

// A compiled plan. Keeps its device's threads alive. One program is not to be recorded from two threads at once; several
// programs of one device may be, and take turns at its threads pass by pass.
class Program {
public:
    // Runs one frame, and returns when it is done. Fails, and writes nothing, where an image or constant of the plan is
    // missing, unknown, of another size or null.
    Result<> record(const FrameInputs<Image>&);

    // Of the last frame, a pass each in the plan's order; empty where timings were not asked for.
    const std::vector<PassTiming>& timings() const;

    const Plan& plan() const;
    MemoryUse memoryUse() const;

    // A transient image's texels, interleaved, with the channels in use: for tests and for looking at what a pass left.
    // Later passes may have reused its memory: read it from within onPass().
    Result<std::vector<float>> readTransient(std::string_view name) const;

    // Replaces a transient image's texels, interleaved, with the channels in use: for tests that give a pass other inputs.
    Result<> writeTransient(std::string_view name, std::span<const float> texels);

    // Called after each pass of record(), with the pass's index; empty: never.
    void onPass(std::function<void(int)> callback);

    struct State;
    explicit Program(std::unique_ptr<State>);
    ~Program();
    Program(Program&&) noexcept;
    Program& operator=(Program&&) noexcept;

private:
    std::unique_ptr<State> state;
};

} // namespace rebound::cpu
