// SPDX-License-Identifier: MIT
// Rebound within the engine: all that concerns it is here, in indirect_light.cpp and in conventionsOf().
#pragma once

#include "objects.hpp"

#include "rebound/techniques/screen_indirect.hpp"
#include "rebound/vulkan/device.hpp"

#include <optional>
#include <string>

namespace rebound::engine {

class IndirectLight {
public:
    // Once.
    static Result<IndirectLight> create(const host::VulkanContext&, bool timings,
                                        vulkan::MemoryAllocator = {});

    // At the start and after a resize. The program before is handed out: it may be destroyed once the GPU is done with it.
    Result<std::optional<vulkan::Program>> compile(const std::string& preset, const GBufferConventions&,
                                                   Extent2D);

    // Every frame.
    Result<> record(VkCommandBuffer, int frame, const ScreenIndirectFrame<vulkan::Image>&);

    // Of the passes last recorded for that frame, once the GPU is done with it.
    Result<std::vector<PassTiming>> timings() const { return program->timings(); }
    MemoryUse memoryUse() const { return program->memoryUse(); }
    const ScreenIndirectSettings& settings() const { return current; }

private:
    explicit IndirectLight(vulkan::Device d) : device(std::move(d)) {}

    vulkan::Device device;
    ScreenIndirectSettings current;
    std::optional<vulkan::Program> program;
};

} // namespace rebound::engine
