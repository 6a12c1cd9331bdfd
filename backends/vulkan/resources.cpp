// SPDX-License-Identifier: MIT
// Images and buffers of a plan, and the memory for them.
#include "device_state.hpp"

#include <algorithm>

namespace rebound::vulkan {
namespace {

VkImageCreateInfo imageInfo(const Resource& r, bool inspectable) {
    auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = vulkanFormat(r.format);
    info.extent = {uint32_t(r.extent.width), uint32_t(r.extent.height), 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
    if (inspectable) info.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return info;
}

VkDeviceSize roundUp(VkDeviceSize size, VkDeviceSize alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

// The type of memory with the wanted properties, better with the preferred ones too.
std::optional<uint32_t> memoryTypeOf(const VkPhysicalDeviceMemoryProperties& types, uint32_t allowed,
                                     VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred) {
    for (VkMemoryPropertyFlags flags : {wanted | preferred, wanted})
        for (uint32_t i = 0; i < types.memoryTypeCount; ++i)
            if ((allowed >> i & 1u) && (types.memoryTypes[i].propertyFlags & flags) == flags) return i;
    return std::nullopt;
}

Error shortOf(VkDeviceSize bytes) {
    return {ErrorCode::outOfMemory, "the plan needs " + std::to_string(bytes) +
                                        " bytes of device memory, which could not be allocated"};
}

Result<MemoryBlock> allocateAlone(const Device::Shared& d, const MemoryRequest& request) {
    const VkDeviceSize size = request.requirements.size;
    const auto type =
        request.hostVisible
            ? memoryTypeOf(d.memoryTypes, request.requirements.memoryTypeBits,
                           VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                           VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)
            : memoryTypeOf(d.memoryTypes, request.requirements.memoryTypeBits, 0,
                           VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (!type) return shortOf(size);
    auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = size;
    info.memoryTypeIndex = *type;
    MemoryBlock block;
    block.memoryType = *type;
    const std::string what = std::to_string(size) + " bytes of device memory";
    if (auto allocated =
            d.check(d.vk.AllocateMemory(d.device, &info, nullptr, &block.memory), "allocating " + what);
        !allocated)
        return allocated.error();
    if (!request.hostVisible) return block;
    if (auto mapped = d.check(d.vk.MapMemory(d.device, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped),
                              "mapping " + what);
        !mapped) {
        d.vk.FreeMemory(d.device, block.memory, nullptr);
        return mapped.error();
    }
    return block;
}

Result<MemoryBlock> allocateByHost(const Device::Shared& d, const MemoryRequest& request) {
    const std::optional<MemoryBlock> block = d.allocator.allocate(request);
    if (!block || !block->memory) return shortOf(request.requirements.size);
    return *block;
}

Result<> createImages(const Device::Shared& d, const Plan& plan, bool inspectable, Transients& transients) {
    const std::vector<Lifetime> lives = lifetimes(plan);
    transients.images.resize(plan.resources.size());
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        if (r.kind != ResourceKind::transient || lives[i].last < 0) continue;
        TransientImage& t = transients.images[i];
        const VkImageCreateInfo info = imageInfo(r, inspectable);
        if (auto made = d.check(d.vk.CreateImage(d.device, &info, nullptr, &t.image), "creating " + r.name);
            !made)
            return made;
        d.setName(VK_OBJECT_TYPE_IMAGE, handleBits(t.image), plan.technique + ": " + r.name);
        d.vk.GetImageMemoryRequirements(d.device, t.image, &t.requirements);
    }
    return {};
}

} // namespace

VkFormat vulkanFormat(Format format) {
    switch (format) {
    case Format::r32f:
        return VK_FORMAT_R32_SFLOAT;
    case Format::rgba16f:
        return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::rgba32f:
        return VK_FORMAT_R32G32B32A32_SFLOAT;
    }
    return VK_FORMAT_UNDEFINED;
}

OwnedMemory::~OwnedMemory() {
    if (!device || !block.memory) return;
    if (device->allocator.free) device->allocator.free(block);
    else device->vk.FreeMemory(device->device, block.memory, nullptr);
}

Result<std::shared_ptr<OwnedMemory>> allocateMemory(const std::shared_ptr<const Device::Shared>& device,
                                                    const MemoryRequest& request) {
    const auto block =
        device->allocator.allocate ? allocateByHost(*device, request) : allocateAlone(*device, request);
    if (!block) return block.error();
    auto memory = std::make_shared<OwnedMemory>();
    memory->device = device;
    memory->block = *block;
    memory->size = request.requirements.size;
    if ((request.hostVisible && !block->mapped) || block->offset % request.requirements.alignment != 0)
        return invalidArgument("allocator: the block of " + std::to_string(memory->size) +
                               " bytes is not mapped, or its offset is no multiple of the alignment");
    return memory;
}

Result<Transients> createTransients(const Device::Shared& d, const Plan& plan, bool inspectable) {
    Transients transients;
    if (auto made = createImages(d, plan, inspectable, transients); !made) {
        destroyTransients(d, transients);
        return made.error();
    }
    transients.block = {0, 1, ~0u};
    std::vector<size_t> sizes;
    for (const TransientImage& t : transients.images) {
        sizes.push_back(size_t(t.requirements.size));
        if (!t.image) continue;
        transients.block.alignment = std::max(transients.block.alignment, t.requirements.alignment);
        transients.block.memoryTypeBits &= t.requirements.memoryTypeBits;
    }
    transients.layout = layoutTransients(plan, sizes, size_t(transients.block.alignment));
    transients.block.size = transients.layout.size;
    return transients;
}

void destroyTransients(const Device::Shared& d, Transients& transients) {
    for (TransientImage& t : transients.images) {
        if (t.view) d.vk.DestroyImageView(d.device, t.view, nullptr);
        if (t.image) d.vk.DestroyImage(d.device, t.image, nullptr);
    }
    transients.images.clear();
}

BufferLayout layoutBuffers(const Device::Shared& d, const Plan& plan, int framesInFlight) {
    const VkDeviceSize alignment =
        std::max(d.limits.minUniformBufferOffsetAlignment, d.limits.minStorageBufferOffsetAlignment);
    BufferLayout layout;
    layout.offsets.resize(plan.resources.size());
    const auto place = [&](ResourceKind kind) {
        for (size_t i = 0; i < plan.resources.size(); ++i)
            if (plan.resources[i].kind == kind) {
                layout.offsets[i] = layout.size;
                layout.size += roundUp(plan.resources[i].size, alignment);
            }
    };
    place(ResourceKind::buffer);
    layout.frameOffset = layout.size;
    place(ResourceKind::frameConstants);
    layout.frameStride = layout.size - layout.frameOffset;
    layout.size += layout.frameStride * VkDeviceSize(framesInFlight - 1);
    return layout;
}

} // namespace rebound::vulkan
