// SPDX-License-Identifier: MIT
// Plans run on any backend, with images of the lab: what the command line and the conformance tests share.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/cpu/device.hpp"
#include "rebound/device.hpp"
#include "rebound/shaders.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rebound::runner {

// How a host keeps normals, colours and radiance; depth, and whatever else a plan advises so, is always in single
// precision.
enum class Precision { half, single };

// A frame as techniques fill it, such as screenIndirectInputs(). A backend makes the outputs' images and output buffers
// itself: what stands for them here is not looked at. Images of unsigned integers are given as floats of the same bits.
// Bytes of an input buffer are handed to the device once, and shared by all plans of the backend that are given them.
using PlanInputs = FrameInputs<lab::Image>;

// What a pass has written.
struct WrittenImage {
    ResourceIndex resource = 0;
    lab::Image
        image; // the channels in use; of unsigned integers: floats of the same bits. Of a buffer of numbers: one row
};
// By pass.
using Record = std::vector<std::vector<WrittenImage>>;

// A plan, compiled, with images for its inputs and outputs.
class PreparedPlan {
public:
    virtual ~PreparedPlan() = default;

    // What the host hands in with the frames from now on, until it is replaced. Fails, and keeps what it had, where a
    // picture or constants are missing or of another size.
    virtual Result<> setInputs(const PlanInputs&) = 0;
    // Runs one frame. Returns what it took until its outputs were there [ms].
    virtual Result<double> run() = 0;
    // The next frame of a sequence: setInputs(), then run(), whose time it returns.
    Result<double> runFrame(const PlanInputs&);
    // Of the last run(), a pass each; empty where the backend cannot tell.
    virtual const std::vector<PassTiming>& timings() const = 0;
    // What recording the last run() took the host, where a GPU then does the work [ms]; nothing on the CPU.
    virtual std::optional<double> recordingTime() const { return {}; }
    virtual MemoryUse memoryUse() const = 0;
    // An output, or an output buffer as WrittenImage has it.
    virtual Result<lab::Image> read(const std::string& output) = 0;
    // The next frame is a first one: history and persistent buffers hold zeros.
    virtual void reset() = 0;

    // Runs one frame and tells what every pass has written. Behind each pass, what it has written is replaced: by what
    // `replacement` holds for it, so that no difference outlives its pass, or, without one, by itself in the precision
    // of the plan's formats. Fails where the plan was not prepared for inspection.
    virtual Result<Record> inspect(const Record* replacement) = 0;
};

struct PrepareOptions {
    Precision precision = Precision::half;
    bool inspectable = false;
};

struct BackendInfo {
    std::string backend; // cpu, vulkan or opengl
    std::string device;  // as the driver calls it; empty for the CPU
    std::string isa;     // of the CPU
    int threads = 0;     // of the CPU
};
// Such as "avx512 on 2 threads", or "vulkan on llvmpipe".
std::string toText(const BackendInfo&);

class Backend {
public:
    virtual ~Backend() = default;

    virtual BackendInfo info() const = 0;
    virtual Result<MemoryUse> memoryUse(const Plan&) const = 0;
    // Ready to run the first frame, which has those inputs.
    virtual Result<std::unique_ptr<PreparedPlan>> prepare(const Plan&, const PlanInputs&,
                                                          const PrepareOptions&) = 0;
    // What a driver's checks have complained about since they were last asked; asked for with BackendChoice::validation.
    virtual std::vector<std::string> complaints() { return {}; }
};

struct BackendChoice {
    std::string backend = "cpu"; // one of backendNames()
    std::string device;          // of vulkan and opengl: part of its name; empty: the backend's first
    cpu::Isa isa = cpu::Isa::automatic;
    int threads = 0;         // of the CPU; 0: one a core
    bool validation = false; // of vulkan: its validation layers; of opengl: debug output
    // Kernels beside the techniques' own.
    std::vector<std::span<const cpu::KernelEntry* const> (*)(cpu::Isa)> moreKernels = {};
    std::vector<std::span<const Shader* const>> moreShaders = {};
};

// Those that are built in: cpu, and vulkan and opengl where they are.
std::vector<std::string> backendNames();

// Fails where the backend is unknown, not built in, or has no such device.
Result<std::unique_ptr<Backend>> createBackend(const BackendChoice&);

Result<std::unique_ptr<Backend>> createCpuBackend(const BackendChoice&);
#ifdef REBOUND_HAS_VULKAN
Result<std::unique_ptr<Backend>> createVulkanBackend(const BackendChoice&);
#endif
#ifdef REBOUND_HAS_OPENGL
Result<std::unique_ptr<Backend>> createOpenGLBackend(const BackendChoice&);
#endif

// The input's picture, or an error that names it.
Result<const lab::Image*> findPicture(const Plan&, const PlanInputs&, const Resource&);
// The input buffer's bytes, or an error that names it.
Result<SharedBytes> findBytes(const Plan&, const PlanInputs&, const Resource&);
// That every input has a picture, and all frame constants and input buffers their bytes.
Result<> checkInputs(const Plan&, const PlanInputs&);
// A buffer of numbers as one row, and back.
lab::Image rowOf(std::span<const std::byte>);
std::vector<std::byte> bytesOf(const lab::Image& row);

// A device's buffers, made once for each set of bytes that plans are given.
template <class Buffer>
class SharedBuffers {
public:
    template <class Device>
    Result<Buffer> obtain(const Device& device, const SharedBytes& bytes) {
        for (const auto& [known, buffer] : made)
            if (known == bytes) return buffer;
        auto buffer = device.createBuffer(*bytes);
        if (buffer) made.emplace_back(bytes, *buffer);
        return buffer;
    }

private:
    std::vector<std::pair<SharedBytes, Buffer>> made;
};

// How GPUs are given an input of the host's.
Format inputFormat(const Resource&, Precision);

} // namespace rebound::runner
