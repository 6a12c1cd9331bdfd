// SPDX-License-Identifier: MIT
#include "lab/host/vulkan_image.hpp"

namespace rebound::host {
namespace {

Result<VkDeviceMemory> allocate(const VulkanContext& context, const VkMemoryRequirements& needs,
                                VkMemoryPropertyFlags flags) {
    const int type = context.memoryType(needs.memoryTypeBits, flags);
    if (type < 0)
        return Error{ErrorCode::unsupported, "Vulkan: the device has no memory of the kind that is needed"};
    auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    info.memoryTypeIndex = uint32_t(type);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    if (auto made = check(vkAllocateMemory(context.device(), &info, nullptr, &memory), "allocating memory");
        !made)
        return made.error();
    return memory;
}

VkBufferImageCopy wholeImage(VkDeviceSize offset, Extent2D extent) {
    VkBufferImageCopy copy{};
    copy.bufferOffset = offset;
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {uint32_t(extent.width), uint32_t(extent.height), 1};
    return copy;
}

} // namespace

Result<std::unique_ptr<VulkanBuffer>> VulkanBuffer::create(const VulkanContext& context, VkDeviceSize size,
                                                           VkBufferUsageFlags usage,
                                                           VkMemoryPropertyFlags flags) {
    std::unique_ptr<VulkanBuffer> result(new VulkanBuffer(context.device()));
    auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = result->size = size;
    info.usage = usage;
    if (auto made =
            check(vkCreateBuffer(context.device(), &info, nullptr, &result->buffer), "creating a buffer");
        !made)
        return made.error();
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(context.device(), result->buffer, &needs);
    auto memory = allocate(context, needs, flags);
    if (!memory) return memory.error();
    result->memory = *memory;
    if (auto bound =
            check(vkBindBufferMemory(context.device(), result->buffer, *memory, 0), "binding memory");
        !bound)
        return bound.error();
    void* mapped = nullptr;
    if (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)
        if (auto done =
                check(vkMapMemory(context.device(), *memory, 0, VK_WHOLE_SIZE, 0, &mapped), "mapping memory");
            !done)
            return done.error();
    result->mapped = static_cast<std::byte*>(mapped);
    return result;
}

VulkanBuffer::~VulkanBuffer() {
    if (buffer) vkDestroyBuffer(device, buffer, nullptr);
    if (memory) vkFreeMemory(device, memory, nullptr);
}

Result<std::unique_ptr<VulkanImage>> VulkanImage::create(const VulkanContext& context, Extent2D extent,
                                                         VkFormat format, VkImageUsageFlags usage,
                                                         VkImageAspectFlags aspect) {
    std::unique_ptr<VulkanImage> result(new VulkanImage(context.device()));
    result->format = format;
    result->extent = extent;
    auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {uint32_t(extent.width), uint32_t(extent.height), 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    if (auto made =
            check(vkCreateImage(context.device(), &info, nullptr, &result->image), "creating an image");
        !made)
        return made.error();
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(context.device(), result->image, &needs);
    auto memory = allocate(context, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (!memory) return memory.error();
    result->memory = *memory;
    if (auto bound = check(vkBindImageMemory(context.device(), result->image, *memory, 0), "binding memory");
        !bound)
        return bound.error();
    auto view = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    view.image = result->image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {aspect, 0, 1, 0, 1};
    if (auto made = check(vkCreateImageView(context.device(), &view, nullptr, &result->view),
                          "creating an image view");
        !made)
        return made.error();
    return result;
}

VulkanImage::~VulkanImage() {
    if (view) vkDestroyImageView(device, view, nullptr);
    if (image) vkDestroyImage(device, image, nullptr);
    if (memory) vkFreeMemory(device, memory, nullptr);
}

void recordTransition(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
                      VkImageAspectFlags aspect) {
    auto barrier = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {aspect, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0,
                         0, nullptr, 0, nullptr, 1, &barrier);
}

void recordFullBarrier(VkCommandBuffer commands) {
    auto barrier = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                         nullptr, 0, nullptr);
}

void recordUpload(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkImage image,
                  Extent2D extent) {
    const VkBufferImageCopy copy = wholeImage(offset, extent);
    vkCmdCopyBufferToImage(commands, buffer, image, VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
}

void recordDownload(VkCommandBuffer commands, VkImage image, Extent2D extent, VkBuffer buffer,
                    VkDeviceSize offset) {
    const VkBufferImageCopy copy = wholeImage(offset, extent);
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_GENERAL, buffer, 1, &copy);
}

} // namespace rebound::host
