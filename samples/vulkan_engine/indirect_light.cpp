// SPDX-License-Identifier: MIT
#include "indirect_light.hpp"

namespace rebound::engine {

// [rebound device]
Result<IndirectLight> IndirectLight::create(const host::VulkanContext& context, bool timings,
                                            vulkan::MemoryAllocator allocator) {
    vulkan::DeviceOptions options;
    options.getInstanceProcAddr = vkGetInstanceProcAddr;
    options.instance = context.instance();
    options.physicalDevice = context.physicalDevice();
    options.device = context.device();
    options.queueFamily = context.queueFamily();
    options.allocator = std::move(allocator);
    options.timings = timings;
    options.debugUtils = context.hasDebugUtils(); // names and labels, for captures and validation
    auto device = vulkan::Device::create(options);
    if (!device) return device.error();
    return IndirectLight(*std::move(device));
}
// [/rebound device]

// [rebound compile]
Result<std::optional<vulkan::Program>>
IndirectLight::compile(const std::string& preset, const GBufferConventions& conventions, Extent2D size) {
    auto settings = screenIndirectPreset(preset, size);
    if (!settings) return settings.error();
    settings->conventions = conventions;
    auto plan = planScreenIndirect(*settings);
    if (!plan) return plan.error();
    vulkan::CompileOptions options;
    options.framesInFlight = framesInFlight;
    auto compiled = device.compile(*plan, options);
    if (!compiled) return compiled.error();
    current = *settings;
    return std::exchange(program, *std::move(compiled)); // the old one: frames in flight may still use it
}
// [/rebound compile]

// [rebound record]
Result<> IndirectLight::record(VkCommandBuffer commands, int frame,
                               const ScreenIndirectFrame<vulkan::Image>& images) {
    auto inputs = screenIndirectInputs(current, images);
    if (!inputs) return inputs.error();
    return program->record(commands, frame, *inputs);
}
// [/rebound record]

} // namespace rebound::engine
