// SPDX-License-Identifier: MIT
// Device memory from the host.
#pragma once

#include <vulkan/vulkan_core.h>

#include <functional>
#include <optional>

namespace rebound::vulkan {

struct MemoryRequest {
    VkMemoryRequirements requirements{}; // size, alignment and memory types
    bool hostVisible = false; // whether the host writes to it: then it is HOST_VISIBLE and HOST_COHERENT,
                              // better DEVICE_LOCAL too; otherwise DEVICE_LOCAL
};

struct MemoryBlock {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0; // a multiple of the alignment [bytes]
    uint32_t memoryType = 0;
    void* mapped = nullptr; // of host-visible memory: the block's first byte
    void* tag = nullptr;    // the host's own
};

// Both or neither. allocate answers nothing where memory is short. Called from the threads that compile programs and
// destroy them.
struct MemoryAllocator {
    std::function<std::optional<MemoryBlock>(const MemoryRequest&)> allocate;
    std::function<void(const MemoryBlock&)> free;
};

} // namespace rebound::vulkan
