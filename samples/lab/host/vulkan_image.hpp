// SPDX-License-Identifier: MIT
// Images and buffers of a Vulkan host, each with memory of its own.
#pragma once

#include "lab/host/vulkan_context.hpp"
#include "rebound/extent.hpp"

#include <memory>

namespace rebound::host {

// The context outlives them.
struct VulkanBuffer {
    static Result<std::unique_ptr<VulkanBuffer>> create(const VulkanContext&, VkDeviceSize,
                                                        VkBufferUsageFlags, VkMemoryPropertyFlags);
    VulkanBuffer(const VulkanBuffer&) = delete;
    VulkanBuffer& operator=(const VulkanBuffer&) = delete;
    ~VulkanBuffer();

    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr; // where the memory is host-visible

private:
    explicit VulkanBuffer(VkDevice d) : device(d) {}
    VkDevice device;
};

// 2D, one level, with a view of all of it.
struct VulkanImage {
    static Result<std::unique_ptr<VulkanImage>> create(const VulkanContext&, Extent2D, VkFormat,
                                                       VkImageUsageFlags,
                                                       VkImageAspectFlags = VK_IMAGE_ASPECT_COLOR_BIT);
    VulkanImage(const VulkanImage&) = delete;
    VulkanImage& operator=(const VulkanImage&) = delete;
    ~VulkanImage();

    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    Extent2D extent;

private:
    explicit VulkanImage(VkDevice d) : device(d) {}
    VkDevice device;
};

// A transition, with everything before it done and visible to everything behind.
void recordTransition(VkCommandBuffer, VkImage, VkImageLayout from, VkImageLayout to,
                      VkImageAspectFlags = VK_IMAGE_ASPECT_COLOR_BIT);
// Everything before is done and visible to everything behind: for hosts that do not count microseconds.
void recordFullBarrier(VkCommandBuffer);

// Between a buffer of tightly packed texels, from an offset on, and a whole image in layout GENERAL.
void recordUpload(VkCommandBuffer, VkBuffer, VkDeviceSize offset, VkImage, Extent2D);
void recordDownload(VkCommandBuffer, VkImage, Extent2D, VkBuffer, VkDeviceSize offset);

} // namespace rebound::host
