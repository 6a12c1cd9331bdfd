// SPDX-License-Identifier: MIT
#include "objects.hpp"

#include <cstring>

namespace rebound::engine {
namespace {

constexpr VkMemoryPropertyFlags hostMemory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

Result<std::unique_ptr<host::VulkanBuffer>> stagingBuffer(const host::VulkanContext& context,
                                                          std::span<const std::byte> bytes) {
    auto staging =
        host::VulkanBuffer::create(context, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, hostMemory);
    if (staging) std::memcpy((*staging)->mapped, bytes.data(), bytes.size());
    return staging;
}

} // namespace

Objects::~Objects() {
    while (!destructors.empty()) {
        destructors.back()();
        destructors.pop_back();
    }
}

template <class T>
T* Objects::keep(Result<std::unique_ptr<T>> object) {
    if (!object) {
        made = object.error();
        return nullptr;
    }
    std::shared_ptr<T> shared = *std::move(object);
    destructors.push_back([shared]() mutable { shared.reset(); });
    return shared.get();
}

Objects::Image Objects::image(Extent2D extent, VkFormat format, VkImageUsageFlags usage,
                              VkImageAspectFlags aspect) {
    if (failed()) return {};
    const auto* image = keep(host::VulkanImage::create(context, extent, format, usage, aspect));
    return image ? Image{image->image, image->view, format, extent} : Image{};
}

VkBuffer Objects::buffer(std::span<const std::byte> bytes, VkBufferUsageFlags usage) {
    if (failed()) return VK_NULL_HANDLE;
    auto staging = stagingBuffer(context, bytes);
    if (!staging) return fail(staging.error()), VK_NULL_HANDLE;
    const auto* buffer =
        keep(host::VulkanBuffer::create(context, bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
    if (!buffer) return VK_NULL_HANDLE;
    made = context.run([&](VkCommandBuffer commands) -> Result<> {
        const VkBufferCopy all{0, 0, bytes.size()};
        vkCmdCopyBuffer(commands, (*staging)->buffer, buffer->buffer, 1, &all);
        host::recordFullBarrier(commands);
        return {};
    });
    return buffer->buffer;
}

Objects::Image Objects::texture(Extent2D extent, VkFormat format, std::span<const std::byte> texels) {
    const Image result = image(extent, format, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    if (failed()) return {};
    auto staging = stagingBuffer(context, texels);
    if (!staging) return fail(staging.error()), Image{};
    made = context.run([&](VkCommandBuffer commands) -> Result<> {
        host::recordTransition(commands, result.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
        host::recordUpload(commands, (*staging)->buffer, 0, result.image, extent);
        host::recordTransition(commands, result.image, VK_IMAGE_LAYOUT_GENERAL,
                               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        return {};
    });
    return result;
}

host::VulkanBuffer* Objects::mappedBuffer(VkDeviceSize size, VkBufferUsageFlags usage) {
    return failed() ? nullptr : keep(host::VulkanBuffer::create(context, size, usage, hostMemory));
}

VkDescriptorSetLayout Objects::setLayout(std::initializer_list<VkDescriptorType> types,
                                         VkShaderStageFlags stages) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (VkDescriptorType type : types)
        bindings.push_back({uint32_t(bindings.size()), type, 1, stages, nullptr});
    auto info =
        structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = uint32_t(bindings.size());
    info.pBindings = bindings.data();
    return make(vkCreateDescriptorSetLayout, vkDestroyDescriptorSetLayout, info,
                "creating a descriptor set layout");
}

VkDescriptorPool Objects::descriptorPool(uint32_t sets, std::initializer_list<VkDescriptorPoolSize> sizes) {
    auto info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = sets;
    info.poolSizeCount = uint32_t(sizes.size());
    info.pPoolSizes = sizes.begin();
    return make(vkCreateDescriptorPool, vkDestroyDescriptorPool, info, "creating a descriptor pool");
}

VkDescriptorSet Objects::descriptorSet(VkDescriptorPool pool, VkDescriptorSetLayout layout) {
    auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    if (!failed())
        made = host::check(vkAllocateDescriptorSets(context.device(), &info, &set),
                           "allocating a descriptor set");
    return set;
}

VkPipelineLayout Objects::pipelineLayout(std::initializer_list<VkDescriptorSetLayout> sets,
                                         VkShaderStageFlags pushStages, uint32_t pushSize) {
    const VkPushConstantRange push{pushStages, 0, pushSize};
    auto info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = uint32_t(sets.size());
    info.pSetLayouts = sets.begin();
    info.pushConstantRangeCount = pushSize > 0 ? 1 : 0;
    info.pPushConstantRanges = &push;
    return make(vkCreatePipelineLayout, vkDestroyPipelineLayout, info, "creating a pipeline layout");
}

VkSampler Objects::sampler(VkFilter filter, VkSamplerAddressMode u, VkSamplerAddressMode v) {
    auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = info.minFilter = filter;
    info.addressModeU = u;
    info.addressModeV = v;
    return make(vkCreateSampler, vkDestroySampler, info, "creating a sampler");
}

void writeImage(VkDevice device, VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                VkSampler sampler, VkImageView view, VkImageLayout layout) {
    const VkDescriptorImageInfo image{sampler, view, layout};
    auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = type;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
}

void writeBuffer(VkDevice device, VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                 VkBuffer buffer, VkDeviceSize size) {
    const VkDescriptorBufferInfo range{buffer, 0, size};
    auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = type;
    write.pBufferInfo = &range;
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
}

} // namespace rebound::engine
