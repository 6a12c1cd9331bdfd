// SPDX-License-Identifier: MIT
// Images and buffers of a plan, and the memory for them.
#include "device_state.hpp"

#include <algorithm>

namespace rebound::vulkan {
namespace {

VkImageCreateInfo imageInfo(const Resource& r, VkImageUsageFlags transfers) {
    auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = vulkanFormat(r.format);
    info.extent = {uint32_t(r.extent.width), uint32_t(r.extent.height), 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | transfers;
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

Result<> createImage(const Device::Shared& d, const Plan& plan, const Resource& r,
                     VkImageUsageFlags transfers, OwnImage& own) {
    const VkImageCreateInfo info = imageInfo(r, transfers);
    if (auto made = d.check(d.vk.CreateImage(d.device, &info, nullptr, &own.image), "creating " + r.name);
        !made)
        return made;
    d.setName(VK_OBJECT_TYPE_IMAGE, handleBits(own.image), plan.technique + ": " + r.name);
    d.vk.GetImageMemoryRequirements(d.device, own.image, &own.requirements);
    return {};
}

constexpr VkBufferUsageFlags transfersOf(bool inspectable) {
    return inspectable ? VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT : 0;
}
// Of the same bits.
static_assert(int(VK_BUFFER_USAGE_TRANSFER_SRC_BIT) == int(VK_IMAGE_USAGE_TRANSFER_SRC_BIT) &&
              int(VK_BUFFER_USAGE_TRANSFER_DST_BIT) == int(VK_IMAGE_USAGE_TRANSFER_DST_BIT));

// What a block of memory needs for these; its size is not known yet.
VkMemoryRequirements blockFor(const Device::Shared& d, const std::vector<const OwnImage*>& images,
                              const std::vector<OwnBuffer>& buffers) {
    VkMemoryRequirements block{0, 1, ~0u};
    bool hasImages = false, hasBuffers = false;
    const auto add = [&](const VkMemoryRequirements& needs, bool& has) {
        has = true;
        block.alignment = std::max(block.alignment, needs.alignment);
        block.memoryTypeBits &= needs.memoryTypeBits;
    };
    for (const OwnImage* image : images)
        if (image->image) add(image->requirements, hasImages);
    for (const OwnBuffer& buffer : buffers)
        if (buffer.buffer) add(buffer.requirements, hasBuffers);
    // So far apart that images and buffers cannot disturb each other.
    if (hasImages && hasBuffers) block.alignment = std::max(block.alignment, d.limits.bufferImageGranularity);
    return block;
}

Result<> createAll(const Device::Shared& d, const Plan& plan, bool inspectable, Transients& transients) {
    const std::vector<Lifetime> lives = lifetimes(plan);
    transients.images.resize(plan.resources.size());
    transients.buffers.resize(plan.resources.size());
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        if (!isTransient(r.kind) || lives[i].last < 0) continue;
        if (isImage(r.kind)) {
            if (auto made = createImage(d, plan, r, transfersOf(inspectable), transients.images[i]); !made)
                return made;
            continue;
        }
        auto buffer = createOwnBuffer(d, plan.technique + ": " + r.name, r.size, transfersOf(inspectable));
        if (!buffer) return buffer.error();
        transients.buffers[i] = *buffer;
    }
    return {};
}

Result<> createAll(const Device::Shared& d, const Plan& plan, bool inspectable, Persistent& p) {
    // They are cleared before a first frame.
    const VkBufferUsageFlags transfers = transfersOf(inspectable) | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    p.images.resize(plan.resources.size());
    p.buffers.resize(plan.resources.size());
    p.offsets.resize(plan.resources.size());
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        if (r.kind == ResourceKind::history)
            for (OwnImage& image : p.images[i])
                if (auto made = createImage(d, plan, r, transfers, image); !made) return made;
        if (r.kind != ResourceKind::persistentBuffer) continue;
        auto buffer = createOwnBuffer(d, plan.technique + ": " + r.name, r.size, transfers);
        if (!buffer) return buffer.error();
        p.buffers[i] = *buffer;
    }
    return {};
}

void destroyImage(const Device::Shared& d, const OwnImage& image) {
    if (image.view) d.vk.DestroyImageView(d.device, image.view, nullptr);
    if (image.image) d.vk.DestroyImage(d.device, image.image, nullptr);
}

void destroyBuffers(const Device::Shared& d, std::vector<OwnBuffer>& buffers) {
    for (OwnBuffer& b : buffers)
        if (b.buffer) d.vk.DestroyBuffer(d.device, b.buffer, nullptr);
    buffers.clear();
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
    case Format::r32ui:
        return VK_FORMAT_R32_UINT;
    case Format::rgba32ui:
        return VK_FORMAT_R32G32B32A32_UINT;
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

Result<OwnBuffer> createOwnBuffer(const Device::Shared& d, const std::string& name, VkDeviceSize size,
                                  VkBufferUsageFlags usage) {
    auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = roundUp(size, 4); // which is cleared whole
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | usage;
    OwnBuffer own;
    if (auto made = d.check(d.vk.CreateBuffer(d.device, &info, nullptr, &own.buffer), "creating " + name);
        !made)
        return made.error();
    d.setName(VK_OBJECT_TYPE_BUFFER, handleBits(own.buffer), name);
    d.vk.GetBufferMemoryRequirements(d.device, own.buffer, &own.requirements);
    return own;
}

Result<> bindImage(const Device::Shared& d, const Resource& r, const OwnedMemory& memory, VkDeviceSize offset,
                   OwnImage& own) {
    if (auto bound = d.check(
            d.vk.BindImageMemory(d.device, own.image, memory.block.memory, memory.block.offset + offset),
            "binding memory to " + r.name);
        !bound)
        return bound;
    auto info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = own.image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = vulkanFormat(r.format);
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    return d.check(d.vk.CreateImageView(d.device, &info, nullptr, &own.view), "creating a view of " + r.name);
}

Result<> bindBuffer(const Device::Shared& d, const std::string& name, const OwnedMemory& memory,
                    VkDeviceSize offset, const OwnBuffer& own) {
    return d.check(
        d.vk.BindBufferMemory(d.device, own.buffer, memory.block.memory, memory.block.offset + offset),
        "binding memory to " + name);
}

Result<Transients> createTransients(const Device::Shared& d, const Plan& plan, bool inspectable) {
    Transients transients;
    if (auto made = createAll(d, plan, inspectable, transients); !made) {
        destroy(d, transients);
        return made.error();
    }
    std::vector<const OwnImage*> images;
    for (const OwnImage& image : transients.images) images.push_back(&image);
    transients.block = blockFor(d, images, transients.buffers);
    std::vector<size_t> sizes;
    for (size_t i = 0; i < plan.resources.size(); ++i) sizes.push_back(transients.sizeOf(ResourceIndex(i)));
    transients.layout = layoutTransients(plan, sizes, size_t(transients.block.alignment));
    transients.block.size = transients.layout.size;
    return transients;
}

void destroy(const Device::Shared& d, Transients& transients) {
    for (const OwnImage& image : transients.images) destroyImage(d, image);
    transients.images.clear();
    destroyBuffers(d, transients.buffers);
}

Result<Persistent> createPersistent(const Device::Shared& d, const Plan& plan, bool inspectable) {
    Persistent p;
    if (auto made = createAll(d, plan, inspectable, p); !made) {
        destroy(d, p);
        return made.error();
    }
    std::vector<const OwnImage*> images;
    for (const auto& pair : p.images) images.insert(images.end(), {&pair[0], &pair[1]});
    p.block = blockFor(d, images, p.buffers);
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const auto place = [&](VkDeviceSize size, VkDeviceSize& offset) {
            offset = p.block.size;
            p.block.size += roundUp(size, p.block.alignment);
        };
        for (size_t k = 0; k < 2; ++k)
            if (p.images[i][k].image) place(p.images[i][k].requirements.size, p.offsets[i][k]);
        if (p.buffers[i].buffer) place(p.buffers[i].requirements.size, p.offsets[i][0]);
    }
    return p;
}

void destroy(const Device::Shared& d, Persistent& p) {
    for (const auto& pair : p.images)
        for (const OwnImage& image : pair) destroyImage(d, image);
    p.images.clear();
    destroyBuffers(d, p.buffers);
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
    place(ResourceKind::frameState);
    layout.frameStride = layout.size - layout.frameOffset;
    layout.size += layout.frameStride * VkDeviceSize(framesInFlight - 1);
    return layout;
}

} // namespace rebound::vulkan
