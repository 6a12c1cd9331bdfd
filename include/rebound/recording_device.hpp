// SPDX-License-Identifier: MIT
// A device that runs nothing: it checks a plan and a frame as every device does, and keeps a log of what it
// would allocate and run. For tests of a host's logic: resizes, several views, changes of settings, missing
// images.
#pragma once

#include "rebound/detail/kernel_check.hpp"
#include "rebound/device.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rebound::recording {

// Stands for a buffer of the host.
struct Buffer {
    std::string label; // appears in the log
    size_t size = 0;   // [bytes]
};

// Stands for an image of the host.
struct Image {
    using Buffer = recording::Buffer;

    std::string label; // appears in the log
    Extent2D extent;
};

struct BoundResource {
    int slot = 0;
    Access access = Access::read;
    std::string resource; // name in the plan
    std::string image;    // label of the host's image or buffer; empty: the device's own memory, or constants
    size_t offset = 0;    // of transients, in the block that they share [bytes]
    size_t size = 0;      // of what the device holds, or of the constants [bytes]
};

struct RecordedPass {
    std::string label, kernel;
    std::vector<int> features;
    Extent2D grid;
    int items = 0;
    std::vector<BoundResource> bindings;
};

struct RecordedConstants {
    std::string name;
    std::vector<std::byte> data;
};

struct RecordedFrame {
    std::string technique;
    std::vector<RecordedPass> passes;
    std::vector<RecordedConstants> constants;
    bool historyIsValid =
        false; // whether the frame before left some: not in the first frame, and not after reset()
};

struct Allocation {
    std::string what; // "transients", or the name of a buffer or of history
    size_t size = 0;  // [bytes]
};

// What a device and its programs have done so far.
struct Log {
    std::vector<Allocation> allocations;
    std::vector<RecordedFrame> frames;
    int livePrograms = 0;
    size_t liveBytes = 0; // that live programs hold
    size_t peakBytes = 0; // the most that were live at once
};

struct DeviceOptions {
    size_t memoryLimit = std::numeric_limits<size_t>::max(); // of all live programs together [bytes]
    std::vector<std::string> kernels;                        // those that exist; empty: all that plans name
};

class Program {
public:
    // Logs one frame. Fails, and logs nothing, where an image, buffer or constant of the plan is missing, unknown or
    // of another size.
    Result<> record(const FrameInputs<Image>& inputs);

    void reset() { state->frames.reset(); }

    // Nothing is timed: always empty.
    Result<std::vector<PassTiming>> timings() const { return std::vector<PassTiming>{}; }
    const Plan& plan() const { return state->plan; }
    MemoryUse memoryUse() const { return state->use; }

private:
    friend class Device;
    // What a compiled plan holds; gives its memory back when it ends.
    struct State {
        Plan plan;
        MemoryUse use;
        std::vector<size_t> sizes; // by resource
        TransientLayout layout;
        detail::FrameCount frames;
        std::shared_ptr<Log> log;

        State() = default;
        State(const State&) = delete;
        State& operator=(const State&) = delete;
        ~State() {
            if (!log) return;
            log->liveBytes -= use.total();
            --log->livePrograms;
        }
    };
    explicit Program(std::unique_ptr<State> s) : state(std::move(s)) {}

    BoundResource bound(const PassBinding& binding, const detail::ResolvedInputs<Image>& inputs) const {
        const size_t i = size_t(binding.resource);
        const std::string host = inputs.images[i]    ? inputs.images[i]->label
                                 : inputs.buffers[i] ? inputs.buffers[i]->label
                                                     : std::string();
        const bool held = !isHostImage(state->plan.resources[i].kind);
        return {binding.slot, binding.access,           state->plan.resources[i].name,
                host,         state->layout.offsets[i], held ? state->sizes[i] : 0};
    }

    std::unique_ptr<State> state;
};

class Device {
public:
    explicit Device(DeviceOptions deviceOptions = {})
        : options(std::move(deviceOptions)), sharedLog(std::make_shared<Log>()) {}

    // Fails where the plan is not valid, names a kernel that does not exist, or exceeds the limit of memory;
    // the device stays as it was.
    Result<Program> compile(const Plan& plan) const;

    // What compile() would allocate: images in the formats of the plan, tightly packed.
    Result<MemoryUse> memoryUse(const Plan& plan) const { return rebound::memoryUse(plan); }

    const Log& log() const { return *sharedLog; }

private:
    Result<> checkKernels(const Plan& plan) const {
        for (const Pass& pass : plan.passes)
            if (!options.kernels.empty() &&
                std::ranges::find(options.kernels, pass.kernel) == options.kernels.end())
                return detail::unknownKernel(pass);
        return {};
    }

    DeviceOptions options;
    std::shared_ptr<Log> sharedLog;
};

inline Result<Program> Device::compile(const Plan& plan) const {
    if (auto valid = validate(plan); !valid) return valid.error();
    if (auto known = checkKernels(plan); !known) return known.error();
    const MemoryUse use = *memoryUse(plan);
    if (use.total() > options.memoryLimit - std::min(options.memoryLimit, sharedLog->liveBytes))
        return Error{ErrorCode::outOfMemory, "the plan needs " + std::to_string(use.total()) +
                                                 " bytes, where " + std::to_string(sharedLog->liveBytes) +
                                                 " of " + std::to_string(options.memoryLimit) +
                                                 " are in use"};
    auto state = std::make_unique<Program::State>();
    state->plan = plan;
    state->use = use;
    for (const Resource& r : plan.resources) state->sizes.push_back(sizeOf(r));
    state->layout = layoutTransients(plan, state->sizes, transientAlignment);
    if (use.transient > 0) sharedLog->allocations.push_back({"transients", use.transient});
    for (const Resource& r : plan.resources)
        if (!isHostImage(r.kind) && !isHostBuffer(r.kind) && !isTransient(r.kind))
            sharedLog->allocations.push_back(
                {r.name, r.kind == ResourceKind::history ? 2 * sizeOf(r) : sizeOf(r)});
    sharedLog->liveBytes += use.total();
    sharedLog->peakBytes = std::max(sharedLog->peakBytes, sharedLog->liveBytes);
    ++sharedLog->livePrograms;
    state->log = sharedLog;
    return Program(std::move(state));
}

inline Result<> Program::record(const FrameInputs<Image>& inputs) {
    const Plan& plan = state->plan;
    auto resolved = detail::resolveInputs(plan, inputs);
    if (!resolved) return resolved.error();
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        if (const Image* image = resolved->images[i]; image && image->extent != r.extent)
            return invalidArgument("inputs.images: " + r.name + " is " + detail::toText(image->extent) +
                                   "; " + detail::toText(r.extent) + " was expected");
        if (const Buffer* buffer = resolved->buffers[i]; buffer && buffer->size < r.size)
            return detail::smallBuffer(r, buffer->size);
    }
    RecordedFrame frame{plan.technique, {}, {}, !state->frames.atStart()};
    for (const Pass& pass : plan.passes) {
        RecordedPass recorded{pass.label, pass.kernel, pass.features, pass.grid, pass.items, {}};
        for (const PassBinding& b : pass.bindings) recorded.bindings.push_back(bound(b, *resolved));
        frame.passes.push_back(std::move(recorded));
    }
    for (const NamedConstants& named : inputs.constants)
        frame.constants.push_back({std::string(named.name), named.data});
    state->log->frames.push_back(std::move(frame));
    state->frames.advance();
    return {};
}

static_assert(ProgramDevice<Device, Program, Image>);

} // namespace rebound::recording
