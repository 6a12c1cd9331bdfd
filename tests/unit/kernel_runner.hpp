// SPDX-License-Identifier: MIT
// Pictures, and kernels run one at a time on them.
#pragma once

#include "rebound/cpu/device.hpp"
#include "rebound/shaders.hpp"

#include <doctest/doctest.h>
#include <glm/glm.hpp>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace rebound::cpu {
std::span<const KernelEntry* const> testKernels(Isa);
std::span<const KernelEntry* const> inputCheckKernels(Isa);
} // namespace rebound::cpu
namespace rebound {
std::span<const Shader* const> testShaders();
}

namespace rebound::test {

#include "rebound/math/uniform_types.h"

#include "kernels/test_constants.h"

// Interleaved floats.
struct Picture {
    Extent2D extent;
    int channels = 4;
    std::vector<float> values;

    Picture() = default;
    Picture(Extent2D e, int channelCount, float value = 0.0f)
        : extent(e), channels(channelCount),
          values(size_t(e.width) * size_t(e.height) * size_t(channelCount), value) {}

    size_t index(int x, int y, int c) const {
        return (size_t(y) * size_t(extent.width) + size_t(x)) * size_t(channels) + size_t(c);
    }
    float& at(int x, int y, int c) { return values[index(x, y, c)]; }
    float at(int x, int y, int c) const { return values[index(x, y, c)]; }
    // Zero outside, as kernels read it.
    float reach(int x, int y, int c) const {
        const bool inside = x >= 0 && y >= 0 && x < extent.width && y < extent.height;
        return inside && c < channels ? at(x, y, c) : 0.0f;
    }
    cpu::Image image() { return cpu::interleavedImage(values.data(), extent, channels); }
};

inline bool sameBits(const Picture& a, const Picture& b) {
    return a.extent == b.extent && a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

// A texel's number as its value: every one differs.
inline Picture numbered(Extent2D extent, int channels = 4) {
    Picture p(extent, channels);
    for (size_t i = 0; i < p.values.size(); ++i) p.values[i] = float(i + 1);
    return p;
}

inline cpu::Device deviceFor(cpu::Isa isa, int threads = 1) {
    cpu::DeviceOptions options;
    options.isa = isa;
    options.threads = threads;
    options.moreKernels = {cpu::testKernels, cpu::inputCheckKernels};
    auto device = cpu::Device::create(options);
    REQUIRE(device);
    return *device;
}

template <class T>
std::vector<std::byte> bytesOf(const T& value) {
    const std::byte* bytes = reinterpret_cast<const std::byte*>(&value);
    return {bytes, bytes + sizeof(T)};
}

inline std::vector<float> floatsOf(const std::vector<std::byte>& bytes) {
    std::vector<float> floats(bytes.size() / sizeof(float));
    std::memcpy(floats.data(), bytes.data(), floats.size() * sizeof(float));
    return floats;
}

// A kernel that reads images of the host and writes one.
struct KernelCall {
    std::string kernel;
    std::vector<int> features;
    std::vector<std::pair<int, Picture*>> inputs;                       // slot, image
    std::vector<std::pair<int, std::vector<std::byte>>> constants = {}; // slot, data
    int outputSlot = 0;
    Extent2D grid;
};

// A plan of one pass that makes the call. Its inputs come first, in the call's order; its output is "result".
inline Plan planOf(const KernelCall& call) {
    Plan plan{"test", {}, {}};
    Pass pass{"pass", call.kernel, call.features, {}, call.grid};
    for (const auto& [slot, picture] : call.inputs)
        pass.bindings.push_back({slot, plan.add({"input " + std::to_string(slot),
                                                 ResourceKind::input,
                                                 Format::rgba32f,
                                                 picture->channels,
                                                 picture->extent,
                                                 {},
                                                 0})});
    for (const auto& [slot, data] : call.constants)
        pass.bindings.push_back({slot, plan.add(bufferResource("constants " + std::to_string(slot), data))});
    pass.bindings.push_back({call.outputSlot,
                             plan.add({"result", ResourceKind::output, Format::rgba32f, 4, call.grid, {}, 0}),
                             Access::write});
    plan.passes.push_back(pass);
    return plan;
}

inline Picture runKernel(cpu::Isa isa, const KernelCall& call) {
    const Plan plan = planOf(call);
    FrameInputs<cpu::Image> inputs;
    Picture result(call.grid, 4);
    for (size_t i = 0; i < call.inputs.size(); ++i)
        inputs.images.push_back({plan.resources[i].name, call.inputs[i].second->image()});
    inputs.images.push_back({"result", result.image()});
    auto program = deviceFor(isa).compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    REQUIRE(program->record(inputs));
    return result;
}

} // namespace rebound::test
