// SPDX-License-Identifier: MIT
#include "functions.hpp"

#include <string>

namespace rebound::vulkan {

Result<Functions> Functions::load(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                                  VkDevice device, bool debugUtils) {
    Functions f;
    std::string missing;
#define REBOUND_LOAD_INSTANCE(name)                                                                          \
    f.name = reinterpret_cast<PFN_vk##name>(getInstanceProcAddr(instance, "vk" #name));                      \
    if (!f.name) missing = "vk" #name;
#define REBOUND_LOAD_DEVICE(name)                                                                            \
    f.name = reinterpret_cast<PFN_vk##name>(f.GetDeviceProcAddr(device, "vk" #name));                        \
    if (!f.name) missing = "vk" #name;
    REBOUND_VULKAN_INSTANCE_FUNCTIONS(REBOUND_LOAD_INSTANCE)
    if (missing.empty()) {
        REBOUND_VULKAN_DEVICE_FUNCTIONS(REBOUND_LOAD_DEVICE)
    }
    if (missing.empty() && debugUtils) {
        REBOUND_VULKAN_DEBUG_FUNCTIONS(REBOUND_LOAD_DEVICE)
    }
#undef REBOUND_LOAD_INSTANCE
#undef REBOUND_LOAD_DEVICE
    if (!missing.empty())
        return Error{
            ErrorCode::unsupported,
            "getInstanceProcAddr knows no " + missing +
                "; a function of Vulkan 1.1, or with debugUtils of VK_EXT_debug_utils, was expected"};
    return f;
}

} // namespace rebound::vulkan
