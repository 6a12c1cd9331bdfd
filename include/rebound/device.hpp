// SPDX-License-Identifier: MIT
// What every device has in common. A device wraps what the engine already has and offers, with its own types,
//
//   Result<Program> compile(const Plan&)               checks the plan, allocates what it needs, once
//   Result<MemoryUse> memoryUse(const Plan&)           what compile would allocate
//   Program::record(..., FrameInputs<Image>)           one frame
//   Program::reset()                                   history and persistent buffers hold zeros from the next frame on
//   Program::timings()                                 a PassTiming a pass of the last frame, if asked for
//
// where Image is the device's handle to an image of the host, and Image::Buffer that to a buffer. Device and its Program
// satisfy the concept ProgramDevice.
#pragma once

#include "rebound/plan.hpp"

#include <array>
#include <concepts>
#include <string_view>

namespace rebound {

namespace detail {
template <class Image>
struct BufferHandle {
    using Type = SharedBytes;
};
template <class Image>
requires requires { typename Image::Buffer; }
struct BufferHandle<Image> {
    using Type = typename Image::Buffer;
};
} // namespace detail

// The buffers that go with a kind of images: Image::Buffer, or bytes where there is none.
template <class Image>
using BufferOf = typename detail::BufferHandle<Image>::Type;

template <class Image>
struct NamedImage {
    std::string name; // of an input or output of the plan
    Image image;
};

template <class Buffer>
struct NamedBuffer {
    std::string name; // of an input buffer or output buffer of the plan
    Buffer buffer;
};

struct NamedConstants {
    std::string name; // of frame constants of the plan
    std::vector<std::byte> data;
};

// Everything that the host hands in with a frame. Techniques fill it: see ScreenIndirectFrame.
template <class Image>
struct FrameInputs {
    std::vector<NamedImage<Image>> images;
    std::vector<NamedConstants> constants;
    std::vector<NamedBuffer<BufferOf<Image>>> buffers = {};
};

// The inputs of two plans, joined as append() has joined the plans with the same options: what has become one is given once.
// Fails, and changes nothing, where frame constants that have become one differ.
template <class Image>
Result<> append(FrameInputs<Image>& inputs, const FrameInputs<Image>& appended,
                const AppendOptions& options = {});

struct PassTiming {
    std::string label; // of the pass
    double milliseconds = 0;
};

// What all devices and their programs offer alike. Image: the device's handle to an image of the host.
template <class Device, class Program, class Image>
concept ProgramDevice = requires(const Device device, Program program, const Program constProgram,
                                 const Plan plan, std::string_view name, BufferOf<Image> buffer) {
    { device.compile(plan) } -> std::same_as<Result<Program>>;
    { device.memoryUse(plan) } -> std::same_as<Result<MemoryUse>>;
    { constProgram.plan() } -> std::same_as<const Plan&>;
    { constProgram.memoryUse() } -> std::same_as<MemoryUse>;
    { constProgram.timings() } -> std::same_as<Result<std::vector<PassTiming>>>;
    program.reset();
    requires std::movable<Program>;
    requires std::copyable<Image>;
    requires std::copyable<BufferOf<Image>>;
};

namespace detail {

// The host's images, buffers and constants in the order of the plan's resources, each exactly once.
template <class Image>
struct ResolvedInputs {
    std::vector<const Image*> images;
    std::vector<const void*> constants;
    std::vector<const BufferOf<Image>*> buffers;
};

// Puts what has a name where the plan's resource of that name is. kindFits: whether a resource of that kind takes it.
template <class Named, class Pointer, class KindFits, class PointerTo>
Result<> resolve(const Plan& plan, const std::vector<Named>& given, std::vector<Pointer>& resolved,
                 const std::string& what, const char* expected, KindFits kindFits, PointerTo pointerTo) {
    resolved.assign(plan.resources.size(), nullptr);
    for (const Named& named : given) {
        const int i = plan.find(named.name);
        if (i < 0 || !kindFits(plan.resources[size_t(i)].kind))
            return invalidArgument(what + ": the plan has no " + expected + " named " + named.name);
        if (resolved[size_t(i)]) return invalidArgument(what + ": " + named.name + " is given twice");
        resolved[size_t(i)] = pointerTo(named);
    }
    for (size_t i = 0; i < plan.resources.size(); ++i)
        if (kindFits(plan.resources[i].kind) && !resolved[i])
            return invalidArgument("inputs: " + plan.resources[i].name + " is missing");
    return {};
}

template <class Image>
Result<ResolvedInputs<Image>> resolveInputs(const Plan& plan, const FrameInputs<Image>& inputs) {
    ResolvedInputs<Image> resolved;
    if (auto found = resolve(plan, inputs.images, resolved.images, "inputs.images", "input or output",
                             isHostImage, [](const auto& named) { return &named.image; });
        !found)
        return found.error();
    if (auto found =
            resolve(plan, inputs.buffers, resolved.buffers, "inputs.buffers", "input buffer or output buffer",
                    isHostBuffer, [](const auto& named) { return &named.buffer; });
        !found)
        return found.error();
    for (const NamedConstants& named : inputs.constants) {
        const int i = plan.find(named.name);
        const bool known = i >= 0 && plan.resources[size_t(i)].kind == ResourceKind::frameConstants;
        if (known && named.data.size() != plan.resources[size_t(i)].size)
            return invalidArgument("inputs.constants: " + named.name + " has " +
                                   std::to_string(named.data.size()) + " bytes; " +
                                   std::to_string(plan.resources[size_t(i)].size) + " were expected");
    }
    if (auto found = resolve(
            plan, inputs.constants, resolved.constants, "inputs.constants", "frame constants",
            [](ResourceKind k) { return k == ResourceKind::frameConstants; },
            [](const auto& named) -> const void* { return named.data.data(); });
        !found)
        return found.error();
    return resolved;
}

inline Error smallBuffer(const Resource& r, size_t size) {
    return invalidArgument("inputs.buffers: " + r.name + " has " + std::to_string(size) + " bytes; " +
                           std::to_string(r.size) + " or more were expected");
}

// How far a program has come: which of the two images of history is written, and what FrameState says. It moves on with
// each frame that is recorded.
class FrameCount {
public:
    // History is to be cleared before the next frame.
    bool atStart() const { return frames == 0; }
    // The index of the image of history that the next frame writes; it reads the other as that of the frame before.
    int written() const { return int(frames & 1); }
    // FrameState of the next frame.
    std::array<int32_t, 4> state() const { return {frames > 0 ? 1 : 0, frames, 0, 0}; }
    // Behind the largest it goes back by one, for history to go on changing places.
    void advance() { frames += frames < 1 << 30 ? 1 : -1; }
    void reset() { frames = 0; }

private:
    int32_t frames = 0;
};

} // namespace detail

template <class Image>
Result<> append(FrameInputs<Image>& inputs, const FrameInputs<Image>& appended,
                const AppendOptions& options) {
    const auto isBound = [&](const std::string& name) {
        return std::ranges::any_of(options.bindings,
                                   [&](const PlanBinding& b) { return b.resource == name; });
    };
    const auto known = [&](const auto& list, const std::string& name) {
        return std::ranges::find_if(list, [&](const auto& named) { return named.name == name; });
    };
    FrameInputs<Image> joined = inputs;
    const auto join = [&](auto& list, const auto& added) {
        for (auto named : added) {
            if (isBound(named.name)) continue;
            named.name = options.hostPrefix + named.name;
            if (known(list, named.name) == list.end()) list.push_back(std::move(named));
        }
    };
    for (const NamedConstants& constants : appended.constants) {
        if (isBound(constants.name)) continue;
        const auto has = known(joined.constants, options.hostPrefix + constants.name);
        if (has != joined.constants.end() && has->data != constants.data)
            return invalidArgument(
                "append: the frame constants " + has->name +
                " differ between the plans' inputs; equal ones, or a host prefix that tells " +
                "them apart, were expected");
    }
    join(joined.images, appended.images);
    join(joined.constants, appended.constants);
    join(joined.buffers, appended.buffers);
    inputs = std::move(joined);
    return {};
}

} // namespace rebound
