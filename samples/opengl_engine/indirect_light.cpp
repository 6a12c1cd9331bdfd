// SPDX-License-Identifier: MIT
#include "indirect_light.hpp"

namespace rebound::engine {

// [rebound device]
Result<IndirectLight> IndirectLight::create(opengl::Loader loader, bool timings) {
    opengl::DeviceOptions options;
    options.loader = std::move(loader); // eglGetProcAddress, glfwGetProcAddress, ...: only create() calls it
    options.timings = timings;
    auto device = opengl::Device::create(options);
    if (!device) return device.error();
    return IndirectLight(*std::move(device));
}
// [/rebound device]

// [rebound compile]
Result<> IndirectLight::compile(const std::string& preset, const GBufferConventions& conventions,
                                Extent2D size) {
    auto settings = screenIndirectPreset(preset, size);
    if (!settings) return settings.error();
    settings->conventions = conventions;
    auto plan = planScreenIndirect(*settings);
    if (!plan) return plan.error();
    auto compiled = device.compile(*plan);
    if (!compiled) return compiled.error();
    current = *settings;
    program = *std::move(compiled); // only now the old one goes: until then the two shared their shaders
    return {};
}
// [/rebound compile]

// [rebound record]
Result<> IndirectLight::record(const ScreenIndirectFrame<opengl::Image>& images) {
    auto inputs = screenIndirectInputs(current, images);
    if (!inputs) return inputs.error();
    return program->record(*inputs);
}
// [/rebound record]

} // namespace rebound::engine
