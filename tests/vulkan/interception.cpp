// SPDX-License-Identifier: MIT
#include "interception.hpp"

#include <map>

namespace rebound::test {
namespace {

bool mustFail() { return interception().calls++ == interception().failAt; }

VkResult counted(VkResult result) {
    if (result == VK_SUCCESS) ++interception().alive;
    return result;
}

// Objects that are created one at a time.
#define REBOUND_COUNTED_OBJECTS(F)                                                                                     \
    F(Buffer)                                                                                                          \
    F(DescriptorPool)                                                                                                  \
    F(DescriptorSetLayout)                                                                                             \
    F(Image)                                                                                                           \
    F(ImageView)                                                                                                       \
    F(PipelineLayout)                                                                                                  \
    F(QueryPool)                                                                                                       \
    F(Sampler)                                                                                                         \
    F(ShaderModule)

#define REBOUND_DEFINE_DESTROY(T)                                                                                      \
    VKAPI_ATTR void VKAPI_CALL Destroy##T(VkDevice device, Vk##T object, const VkAllocationCallbacks* allocator) {     \
        if (object) --interception().alive;                                                                            \
        vkDestroy##T(device, object, allocator);                                                                       \
    }
#define REBOUND_DEFINE_PAIR(T)                                                                                         \
    VKAPI_ATTR VkResult VKAPI_CALL Create##T(VkDevice device, const Vk##T##CreateInfo* info,                           \
                                             const VkAllocationCallbacks* allocator, Vk##T* object) {                  \
        if (mustFail()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;                                                          \
        return counted(vkCreate##T(device, info, allocator, object));                                                  \
    }                                                                                                                  \
    REBOUND_DEFINE_DESTROY(T)
REBOUND_COUNTED_OBJECTS(REBOUND_DEFINE_PAIR)
REBOUND_DEFINE_DESTROY(Pipeline)
REBOUND_DEFINE_DESTROY(PipelineCache)

VKAPI_ATTR VkResult VKAPI_CALL CreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                                   const VkAllocationCallbacks* allocator, VkPipelineCache* cache) {
    if (mustFail()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    interception().cacheSize = info->initialDataSize;
    return counted(vkCreatePipelineCache(device, info, allocator, cache));
}

VKAPI_ATTR VkResult VKAPI_CALL CreateComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
    if (mustFail()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    const VkResult result = vkCreateComputePipelines(device, cache, count, infos, allocator, pipelines);
    if (result == VK_SUCCESS) interception().alive += int(count);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL AllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    if (mustFail()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return counted(vkAllocateMemory(device, info, allocator, memory));
}

VKAPI_ATTR void VKAPI_CALL FreeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* allocator) {
    if (memory) --interception().alive;
    vkFreeMemory(device, memory, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL AllocateDescriptorSets(VkDevice device, const VkDescriptorSetAllocateInfo* info,
                                                      VkDescriptorSet* sets) {
    return mustFail() ? VK_ERROR_OUT_OF_POOL_MEMORY : vkAllocateDescriptorSets(device, info, sets);
}

VKAPI_ATTR VkResult VKAPI_CALL BindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                                VkDeviceSize offset) {
    return mustFail() ? VK_ERROR_OUT_OF_DEVICE_MEMORY : vkBindBufferMemory(device, buffer, memory, offset);
}

VKAPI_ATTR VkResult VKAPI_CALL BindImageMemory(VkDevice device, VkImage image, VkDeviceMemory memory,
                                               VkDeviceSize offset) {
    return mustFail() ? VK_ERROR_OUT_OF_DEVICE_MEMORY : vkBindImageMemory(device, image, memory, offset);
}

VKAPI_ATTR VkResult VKAPI_CALL MapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                                         VkMemoryMapFlags flags, void** mapped) {
    return mustFail() ? VK_ERROR_OUT_OF_HOST_MEMORY : vkMapMemory(device, memory, offset, size, flags, mapped);
}

VKAPI_ATTR void VKAPI_CALL GetImageMemoryRequirements(VkDevice device, VkImage image, VkMemoryRequirements* needs) {
    vkGetImageMemoryRequirements(device, image, needs);
    if (interception().changeImageNeeds) interception().changeImageNeeds(*needs);
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
    vkGetPhysicalDeviceProperties(device, properties);
    if (interception().changeProperties) interception().changeProperties(*properties);
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceQueueFamilyProperties(VkPhysicalDevice device, uint32_t* count,
                                                                  VkQueueFamilyProperties* families) {
    vkGetPhysicalDeviceQueueFamilyProperties(device, count, families);
    for (uint32_t i = 0; families && i < *count; ++i)
        if (interception().changeQueueFamily) interception().changeQueueFamily(families[i]);
}

PFN_vkVoidFunction VKAPI_CALL interceptedDeviceProcAddr(VkDevice device, const char* name) {
    static const std::map<std::string, PFN_vkVoidFunction> functions = {
#define REBOUND_ENTRY(function) {"vk" #function, reinterpret_cast<PFN_vkVoidFunction>(function)},
#define REBOUND_ENTRIES(T) REBOUND_ENTRY(Create##T) REBOUND_ENTRY(Destroy##T)
        REBOUND_COUNTED_OBJECTS(REBOUND_ENTRIES) REBOUND_ENTRY(CreatePipelineCache) REBOUND_ENTRY(DestroyPipelineCache)
            REBOUND_ENTRY(CreateComputePipelines) REBOUND_ENTRY(DestroyPipeline) REBOUND_ENTRY(AllocateMemory)
                REBOUND_ENTRY(FreeMemory) REBOUND_ENTRY(AllocateDescriptorSets) REBOUND_ENTRY(BindBufferMemory)
                    REBOUND_ENTRY(BindImageMemory) REBOUND_ENTRY(MapMemory) REBOUND_ENTRY(GetImageMemoryRequirements)};
    if (name == interception().missing) return nullptr;
    const auto found = functions.find(name);
    return found != functions.end() ? found->second : vkGetDeviceProcAddr(device, name);
}

} // namespace

Interception& interception() {
    static Interception one;
    return one;
}

PFN_vkVoidFunction VKAPI_CALL interceptedProcAddr(VkInstance instance, const char* name) {
    const std::string wanted(name);
    if (wanted == interception().missing) return nullptr;
    if (wanted == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(interceptedDeviceProcAddr);
    if (wanted == "vkGetPhysicalDeviceProperties")
        return reinterpret_cast<PFN_vkVoidFunction>(GetPhysicalDeviceProperties);
    if (wanted == "vkGetPhysicalDeviceQueueFamilyProperties")
        return reinterpret_cast<PFN_vkVoidFunction>(GetPhysicalDeviceQueueFamilyProperties);
    return vkGetInstanceProcAddr(instance, name);
}

} // namespace rebound::test
