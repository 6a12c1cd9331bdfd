// SPDX-License-Identifier: MIT
// Kernels for items, run one at a time on buffers of numbers.
#pragma once

#include "kernel_runner.hpp"

namespace rebound::test {

struct ItemKernelCall {
    std::string kernel;
    std::vector<int> features;
    std::vector<std::pair<int, std::vector<std::byte>>> buffers;   // slot, data: of floats
    std::vector<std::pair<int, std::vector<std::byte>>> constants; // slot, data
    int outputSlot = 0;
    size_t outputSize = 0; // [floats]
    int items = 1;
};

inline std::vector<float> runItemKernel(cpu::Isa isa, const ItemKernelCall& call) {
    Plan plan{"test", {}, {}};
    Pass pass{"pass", call.kernel, call.features, {}, {}, call.items};
    std::vector<float> result(call.outputSize, -7.0f);
    FrameInputs<cpu::Image> inputs;
    std::vector<std::vector<std::byte>> copies;
    for (const auto& [slot, data] : call.buffers) copies.push_back(data);
    for (size_t i = 0; i < copies.size(); ++i) {
        const std::string name = "buffer " + std::to_string(i);
        pass.bindings.push_back(
            {call.buffers[i].first,
             plan.add({name, ResourceKind::inputBuffer, Format::r32f, 1, {}, {}, copies[i].size()})});
        inputs.buffers.push_back({name, cpu::Buffer{copies[i].data(), copies[i].size(), {}}});
    }
    for (const auto& [slot, data] : call.constants) {
        Resource constants = bufferResource("constants " + std::to_string(slot), data);
        pass.bindings.push_back({slot, plan.add(constants)});
    }
    pass.bindings.push_back(
        {call.outputSlot,
         plan.add(
             {"result", ResourceKind::outputBuffer, Format::r32f, 1, {}, {}, result.size() * sizeof(float)}),
         Access::write});
    inputs.buffers.push_back({"result", cpu::Buffer{result.data(), result.size() * sizeof(float), {}}});
    plan.passes.push_back(pass);
    auto program = deviceFor(isa).compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    const auto recorded = program->record(inputs);
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    return result;
}

} // namespace rebound::test
