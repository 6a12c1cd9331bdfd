// SPDX-License-Identifier: MIT
// Vulkan's functions as the host's loader gives them: nothing links to one.
#pragma once

#include "rebound/result.hpp"

#include <vulkan/vulkan_core.h>

namespace rebound::vulkan {

// An empty structure of Vulkan's, with its type.
template <class T>
T structure(VkStructureType type) {
    T value{};
    value.sType = type;
    return value;
}

#define REBOUND_VULKAN_INSTANCE_FUNCTIONS(F)                                                                 \
    F(GetDeviceProcAddr)                                                                                     \
    F(GetPhysicalDeviceProperties)                                                                           \
    F(GetPhysicalDeviceMemoryProperties)                                                                     \
    F(GetPhysicalDeviceQueueFamilyProperties)

#define REBOUND_VULKAN_DEVICE_FUNCTIONS(F)                                                                   \
    F(AllocateDescriptorSets)                                                                                \
    F(AllocateMemory)                                                                                        \
    F(BindBufferMemory)                                                                                      \
    F(BindImageMemory)                                                                                       \
    F(CmdBindDescriptorSets)                                                                                 \
    F(CmdBindPipeline)                                                                                       \
    F(CmdClearColorImage)                                                                                    \
    F(CmdFillBuffer)                                                                                         \
    F(CmdDispatch)                                                                                           \
    F(CmdPipelineBarrier)                                                                                    \
    F(CmdResetQueryPool)                                                                                     \
    F(CmdWriteTimestamp)                                                                                     \
    F(CreateBuffer)                                                                                          \
    F(CreateComputePipelines)                                                                                \
    F(CreateDescriptorPool)                                                                                  \
    F(CreateDescriptorSetLayout)                                                                             \
    F(CreateImage)                                                                                           \
    F(CreateImageView)                                                                                       \
    F(CreatePipelineCache)                                                                                   \
    F(CreatePipelineLayout)                                                                                  \
    F(CreateQueryPool)                                                                                       \
    F(CreateSampler)                                                                                         \
    F(CreateShaderModule)                                                                                    \
    F(DestroyBuffer)                                                                                         \
    F(DestroyDescriptorPool)                                                                                 \
    F(DestroyDescriptorSetLayout)                                                                            \
    F(DestroyImage)                                                                                          \
    F(DestroyImageView)                                                                                      \
    F(DestroyPipeline)                                                                                       \
    F(DestroyPipelineCache)                                                                                  \
    F(DestroyPipelineLayout)                                                                                 \
    F(DestroyQueryPool)                                                                                      \
    F(DestroySampler)                                                                                        \
    F(DestroyShaderModule)                                                                                   \
    F(FreeMemory)                                                                                            \
    F(GetBufferMemoryRequirements)                                                                           \
    F(GetImageMemoryRequirements)                                                                            \
    F(GetPipelineCacheData)                                                                                  \
    F(GetQueryPoolResults)                                                                                   \
    F(MapMemory)                                                                                             \
    F(UpdateDescriptorSets)

// Null where the host has not enabled VK_EXT_debug_utils.
#define REBOUND_VULKAN_DEBUG_FUNCTIONS(F)                                                                    \
    F(CmdBeginDebugUtilsLabelEXT)                                                                            \
    F(CmdEndDebugUtilsLabelEXT)                                                                              \
    F(SetDebugUtilsObjectNameEXT)

struct Functions {
#define REBOUND_DECLARE(name) PFN_vk##name name = nullptr;
    REBOUND_VULKAN_INSTANCE_FUNCTIONS(REBOUND_DECLARE)
    REBOUND_VULKAN_DEVICE_FUNCTIONS(REBOUND_DECLARE)
    REBOUND_VULKAN_DEBUG_FUNCTIONS(REBOUND_DECLARE)
#undef REBOUND_DECLARE

    // Fails where the loader does not know a function.
    static Result<Functions> load(PFN_vkGetInstanceProcAddr, VkInstance, VkDevice, bool debugUtils);
};

} // namespace rebound::vulkan
