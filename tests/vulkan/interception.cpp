// SPDX-License-Identifier: MIT
#include "interception.hpp"

#include <map>

namespace rebound::test {
namespace {

// The error of a call that is to fail.
std::optional<VkResult> failureOf(const char* function, VkResult shortage = VK_ERROR_OUT_OF_DEVICE_MEMORY) {
    if (interception().calls++ != interception().failAt) return std::nullopt;
    interception().failed = function;
    return interception().failure.value_or(shortage);
}

VkResult counted(VkResult result) {
    if (result == VK_SUCCESS) ++interception().alive;
    return result;
}

// Objects that are created one at a time.
#define REBOUND_COUNTED_OBJECTS(F)                                                                           \
    F(Buffer)                                                                                                \
    F(DescriptorPool)                                                                                        \
    F(DescriptorSetLayout)                                                                                   \
    F(Image)                                                                                                 \
    F(ImageView)                                                                                             \
    F(PipelineLayout)                                                                                        \
    F(QueryPool)                                                                                             \
    F(Sampler)                                                                                               \
    F(ShaderModule)

#define REBOUND_DEFINE_DESTROY(T)                                                                            \
    VKAPI_ATTR void VKAPI_CALL Destroy##T(VkDevice device, Vk##T object,                                     \
                                          const VkAllocationCallbacks* allocator) {                          \
        if (object) --interception().alive;                                                                  \
        vkDestroy##T(device, object, allocator);                                                             \
    }
#define REBOUND_DEFINE_PAIR(T)                                                                               \
    VKAPI_ATTR VkResult VKAPI_CALL Create##T(VkDevice device, const Vk##T##CreateInfo* info,                 \
                                             const VkAllocationCallbacks* allocator, Vk##T* object) {        \
        if (const auto failure = failureOf("vkCreate" #T)) return *failure;                                  \
        return counted(vkCreate##T(device, info, allocator, object));                                        \
    }                                                                                                        \
    REBOUND_DEFINE_DESTROY(T)
REBOUND_COUNTED_OBJECTS(REBOUND_DEFINE_PAIR)
REBOUND_DEFINE_DESTROY(Pipeline)
REBOUND_DEFINE_DESTROY(PipelineCache)

VKAPI_ATTR VkResult VKAPI_CALL CreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                                   const VkAllocationCallbacks* allocator,
                                                   VkPipelineCache* cache) {
    if (const auto failure = failureOf("vkCreatePipelineCache")) return *failure;
    interception().cacheSize = info->initialDataSize;
    return counted(vkCreatePipelineCache(device, info, allocator, cache));
}

VKAPI_ATTR VkResult VKAPI_CALL CreateComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines) {
    if (const auto failure = failureOf("vkCreateComputePipelines")) return *failure;
    const VkResult result = vkCreateComputePipelines(device, cache, count, infos, allocator, pipelines);
    if (result == VK_SUCCESS) interception().alive += int(count);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL AllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* allocator,
                                              VkDeviceMemory* memory) {
    if (const auto failure = failureOf("vkAllocateMemory")) return *failure;
    return counted(vkAllocateMemory(device, info, allocator, memory));
}

VKAPI_ATTR void VKAPI_CALL FreeMemory(VkDevice device, VkDeviceMemory memory,
                                      const VkAllocationCallbacks* allocator) {
    if (memory) --interception().alive;
    vkFreeMemory(device, memory, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL AllocateDescriptorSets(VkDevice device,
                                                      const VkDescriptorSetAllocateInfo* info,
                                                      VkDescriptorSet* sets) {
    if (const auto failure = failureOf("vkAllocateDescriptorSets", VK_ERROR_OUT_OF_POOL_MEMORY))
        return *failure;
    return vkAllocateDescriptorSets(device, info, sets);
}

VKAPI_ATTR VkResult VKAPI_CALL BindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                                VkDeviceSize offset) {
    if (const auto failure = failureOf("vkBindBufferMemory")) return *failure;
    return vkBindBufferMemory(device, buffer, memory, offset);
}

VKAPI_ATTR VkResult VKAPI_CALL BindImageMemory(VkDevice device, VkImage image, VkDeviceMemory memory,
                                               VkDeviceSize offset) {
    if (const auto failure = failureOf("vkBindImageMemory")) return *failure;
    return vkBindImageMemory(device, image, memory, offset);
}

VKAPI_ATTR VkResult VKAPI_CALL MapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                         VkDeviceSize size, VkMemoryMapFlags flags, void** mapped) {
    if (const auto failure = failureOf("vkMapMemory", VK_ERROR_OUT_OF_HOST_MEMORY)) return *failure;
    return vkMapMemory(device, memory, offset, size, flags, mapped);
}

VKAPI_ATTR VkResult VKAPI_CALL GetPipelineCacheData(VkDevice device, VkPipelineCache cache, size_t* size,
                                                    void* data) {
    if (const auto failure = failureOf("vkGetPipelineCacheData")) return *failure;
    return vkGetPipelineCacheData(device, cache, size, data);
}

VKAPI_ATTR VkResult VKAPI_CALL GetQueryPoolResults(VkDevice device, VkQueryPool pool, uint32_t first,
                                                   uint32_t count, size_t size, void* data,
                                                   VkDeviceSize stride, VkQueryResultFlags flags) {
    if (const auto failure = failureOf("vkGetQueryPoolResults")) return *failure;
    return vkGetQueryPoolResults(device, pool, first, count, size, data, stride, flags);
}

VKAPI_ATTR void VKAPI_CALL GetImageMemoryRequirements(VkDevice device, VkImage image,
                                                      VkMemoryRequirements* needs) {
    vkGetImageMemoryRequirements(device, image, needs);
    if (interception().changeImageNeeds) interception().changeImageNeeds(*needs);
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties(VkPhysicalDevice device,
                                                       VkPhysicalDeviceProperties* properties) {
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
        REBOUND_COUNTED_OBJECTS(REBOUND_ENTRIES) REBOUND_ENTRY(CreatePipelineCache)
            REBOUND_ENTRY(DestroyPipelineCache) REBOUND_ENTRY(CreateComputePipelines)
                REBOUND_ENTRY(DestroyPipeline) REBOUND_ENTRY(AllocateMemory) REBOUND_ENTRY(FreeMemory)
                    REBOUND_ENTRY(AllocateDescriptorSets) REBOUND_ENTRY(BindBufferMemory)
                        REBOUND_ENTRY(BindImageMemory) REBOUND_ENTRY(MapMemory)
                            REBOUND_ENTRY(GetImageMemoryRequirements) REBOUND_ENTRY(GetPipelineCacheData)
                                REBOUND_ENTRY(GetQueryPoolResults)};
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
    if (wanted == "vkGetDeviceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(interceptedDeviceProcAddr);
    if (wanted == "vkGetPhysicalDeviceProperties")
        return reinterpret_cast<PFN_vkVoidFunction>(GetPhysicalDeviceProperties);
    if (wanted == "vkGetPhysicalDeviceQueueFamilyProperties")
        return reinterpret_cast<PFN_vkVoidFunction>(GetPhysicalDeviceQueueFamilyProperties);
    return vkGetInstanceProcAddr(instance, name);
}

} // namespace rebound::test
