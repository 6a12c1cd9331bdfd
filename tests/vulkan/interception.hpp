// SPDX-License-Identifier: MIT
// Stands between Rebound and the Vulkan loader, as Rebound reaches Vulkan through getInstanceProcAddr alone: counts
// objects, fails calls, and changes what the device says of itself.
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <optional>
#include <string>

namespace rebound::test {

struct Interception {
    int alive = 0;                   // objects created and not destroyed, blocks of memory among them
    int calls = 0;                   // that can fail, so far
    int failAt = -1;                 // the number of the call that is to fail; -1: none
    std::optional<VkResult> failure; // that it fails with; empty: want of memory
    std::string failed;              // the function that failed last
    std::string missing;             // a function that the loader does not know
    size_t cacheSize = 0;            // bytes that the last pipeline cache was begun with
    std::function<void(VkPhysicalDeviceProperties&)> changeProperties;
    std::function<void(VkQueueFamilyProperties&)> changeQueueFamily;
    std::function<void(VkMemoryRequirements&)> changeImageNeeds;
};

// One for all tests, which run one after another; each begins with a fresh one.
Interception& interception();

// The loader's, with the above in between.
PFN_vkVoidFunction VKAPI_CALL interceptedProcAddr(VkInstance, const char* name);

} // namespace rebound::test
