// SPDX-License-Identifier: MIT
// Light that is composed from a bake, within the engine: surfels are lit by the engine's lights and shadow map, in the same
// program that lights pixels. Beside indirect_light.hpp, which is the screen's.
#pragma once

#include "objects.hpp"

#include "lab/engine/moment.hpp"
#include "rebound/bake/bake.hpp"
#include "rebound/techniques/illuminance_composition.hpp"
#include "rebound/vulkan/device.hpp"

#include <array>
#include <memory>
#include <optional>

namespace rebound::engine {

class BakedLight {
public:
    // Once: uploads the bake. emission: whether surfels send what the bake says that they emit. The context outlives it.
    static Result<std::unique_ptr<BakedLight>> create(const host::VulkanContext&, const Bake&, bool emission,
                                                      bool timings);

    // At the start and after a resize, behind which light has to settle anew. The program before is handed out: it may be
    // destroyed once the GPU is done with it.
    Result<std::optional<vulkan::Program>> compile(const GBufferConventions&, Extent2D);

    // Every frame. Of `images` the camera and the images are looked at.
    Result<> record(VkCommandBuffer, int frame, IlluminanceCompositionFrame<vulkan::Image> images,
                    const SurfelSources&, vulkan::Image shadowMap);

    Result<std::vector<PassTiming>> timings() const { return program->timings(); }
    MemoryUse memoryUse() const { return program->memoryUse(); }
    const SurfelLightSettings& lightSettings() const { return lights; }
    const IlluminanceCompositionSettings& settings() const { return current; }

private:
    BakedLight(const host::VulkanContext& context, vulkan::Device d)
        : device(std::move(d)), objects(context) {}
    Result<> makeBuffers();

    vulkan::Device device;
    Objects objects;
    // By frame in flight: written anew once the GPU is done with it.
    std::array<host::VulkanBuffer*, framesInFlight> sources{}, views{};
    std::array<vulkan::Buffer, bakeSectionCount> sections;
    SurfelLightSettings lights;
    IlluminanceCompositionSettings current;
    std::optional<vulkan::Program> program;
};

} // namespace rebound::engine
