// SPDX-License-Identifier: MIT
#include "baked_light.hpp"

#include <cstring>
#include <utility>

namespace rebound::engine {

// [rebound bake]
Result<std::unique_ptr<BakedLight>> BakedLight::create(const host::VulkanContext& context, const Bake& bake,
                                                       bool emission, bool timings) {
    vulkan::DeviceOptions options;
    options.getInstanceProcAddr = vkGetInstanceProcAddr;
    options.instance = context.instance();
    options.physicalDevice = context.physicalDevice();
    options.device = context.device();
    options.queueFamily = context.queueFamily();
    options.timings = timings;
    options.debugUtils = context.hasDebugUtils();
    auto device = vulkan::Device::create(options);
    if (!device) return device.error();
    std::unique_ptr<BakedLight> light(new BakedLight(context, *std::move(device)));
    for (size_t i = 0; i < bake.sections.size(); ++i) {
        if (bake.sections[i].empty()) continue; // no plan asks for it
        auto buffer = light->device.createBuffer(std::as_bytes(bake.sections[i]));
        if (!buffer) return buffer.error();
        light->sections[i] = *std::move(buffer);
    }
    light->lights.surfels = bake.layout.surfels;
    light->lights.maximumSources = maximumSurfelSources;
    light->lights.shadowMaps = {{shadowMapSize, shadowMapSize}};
    light->lights.maximumShadowViews = 1;
    light->lights.handOut = false; // what lights surfels goes on to what composes
    light->current.bake = bake.layout;
    light->current.emission = emission; // not where emissive surfaces are among the lights
    light->current.skipUnchanged = true;
    if (auto made = light->makeBuffers(); !made) return made.error();
    return light;
}
// [/rebound bake]

Result<> BakedLight::makeBuffers() {
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    for (size_t i = 0; i < size_t(framesInFlight); ++i) {
        sources[i] = objects.mappedBuffer(sizeof(LightSource) * size_t(maximumSurfelSources), usage);
        views[i] = objects.mappedBuffer(sizeof(ShadowView), usage);
    }
    return objects.status();
}

// [rebound compile baked]
Result<std::optional<vulkan::Program>> BakedLight::compile(const GBufferConventions& conventions,
                                                           Extent2D size) {
    IlluminanceCompositionSettings next = current;
    next.resolution = size;
    next.conventions = conventions;
    auto plan = planSurfelLight(lights);
    if (!plan) return plan.error();
    auto composition = planIlluminanceComposition(next);
    if (!composition) return composition.error();
    const AppendOptions joining{"", "", {{"surfel light", "surfel light"}}};
    if (auto joined = append(*plan, *composition, joining); !joined) return joined.error();
    vulkan::CompileOptions options;
    options.framesInFlight = framesInFlight;
    auto compiled = device.compile(*plan, options);
    if (!compiled) return compiled.error();
    current = next;
    return std::exchange(program, *std::move(compiled)); // the old one: frames in flight may still use it
}
// [/rebound compile baked]

// [rebound record baked]
Result<> BakedLight::record(VkCommandBuffer commands, int frame,
                            IlluminanceCompositionFrame<vulkan::Image> images,
                            const SurfelSources& surfelSources, vulkan::Image shadowMap) {
    images.sections = sections;
    SurfelLightFrame<vulkan::Image> surfels;
    surfels.sources = int(surfelSources.sources.size());
    surfels.shadowMaps[0] = shadowMap;
    surfels.surfels = sections[size_t(BakeSection::surfels)];
    const host::VulkanBuffer &ofSources = *sources[size_t(frame)], &ofViews = *views[size_t(frame)];
    surfels.lightSources = {ofSources.buffer, 0, ofSources.size, {}};
    surfels.shadowViews = {ofViews.buffer, 0, ofViews.size, {}};
    auto inputs = surfelLightInputs(lights, surfels); // which fails where there are too many sources
    if (!inputs) return inputs.error();
    // The GPU is done with the frame that used these; what the host writes before it submits is there for the GPU.
    std::memcpy(ofSources.mapped, surfelSources.sources.data(),
                sizeof(LightSource) * surfelSources.sources.size());
    std::memcpy(ofViews.mapped, &surfelSources.view, sizeof(ShadowView));
    auto composition = illuminanceCompositionInputs(current, images);
    if (!composition) return composition.error();
    const AppendOptions joining{"", "", {{"surfel light", "surfel light"}}};
    if (auto joined = append(*inputs, *composition, joining); !joined) return joined;
    return program->record(commands, frame, *inputs);
}
// [/rebound record baked]

} // namespace rebound::engine
