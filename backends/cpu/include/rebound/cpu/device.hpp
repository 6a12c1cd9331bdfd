// SPDX-License-Identifier: MIT
// The CPU backend: runs plans on the host's processor, with the instruction set that it has.
#pragma once

#include "rebound/cpu/kernels.hpp"
#include "rebound/cpu/parallel_for.hpp"
#include "rebound/device.hpp"

#include <memory>
#include <span>

namespace rebound::cpu {

enum class Scalar { float32, float16, uint32 };

// A buffer of the host: input buffers are only read. Kept alive during record(); an output buffer overlaps nothing else of
// the frame.
struct Buffer {
    void* data = nullptr; // aligned to 4 bytes
    size_t size = 0;      // at least the plan's resource's [bytes]
    SharedBytes shared;   // of Device::createBuffer(): what data points into
};

// An image of the host, in any regular layout: interleaved or a plane a channel. Fastest: a plane a channel, planes not a
// multiple of 4096 bytes apart, as those of 1280x720 halves are: all channels would compete for a few lines of the cache.
// The host keeps it alive during record(), and no output may overlap any other image of the frame.
struct Image {
    using Buffer = cpu::Buffer;

    void* data = nullptr; // pixel 0, 0 of channel 0
    Extent2D extent;
    int channels = 0;                // 1 to 4; at least as many as the plan's resource has in use
    Scalar scalar = Scalar::float32; // uint32 for formats of unsigned integers, and for those alone
    ptrdiff_t pixelStride = 0;       // from one pixel to its right neighbour [bytes]
    ptrdiff_t rowStride = 0;         // from one row to the next [bytes]
    ptrdiff_t channelStride = 0;     // from one channel to the next [bytes]
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

    // What compile() would allocate: 32 bits a channel in use, rows padded. Fails where the plan is not valid.
    Result<MemoryUse> memoryUse(const Plan&) const;

    // An input buffer that any number of programs are handed in each frame, with a copy of the data that all of them
    // share. It lives as long as a copy of the handle. Fails where memory is short or there is no data.
    Result<Buffer> createBuffer(std::span<const std::byte>) const;

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
    // Runs one frame, and returns when it is done. Fails, and writes nothing, where an image, buffer or constant of the
    // plan is missing, unknown, of another size or null.
    Result<> record(const FrameInputs<Image>&);

    // The next frame is a first one: history and persistent buffers hold zeros, and FrameState says so.
    void reset();

    // Of the last frame, a pass each in the plan's order; empty where timings were not asked for.
    Result<std::vector<PassTiming>> timings() const;

    const Plan& plan() const;
    MemoryUse memoryUse() const;

    // What the device's own image or buffer of that name holds: for tests and for looking at what a pass left. Of images:
    // 32 bits a channel in use, interleaved; of history: the image that the frame writes. Later passes may have reused a
    // transient's memory: read it from within onPass().
    Result<std::vector<std::byte>> read(std::string_view name) const;

    // Replaces what read() gives: for tests that give a pass other inputs. Fails where the size is another.
    Result<> write(std::string_view name, std::span<const std::byte>);

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
