// SPDX-License-Identifier: MIT
// Vulkan objects that are destroyed together, the last one first. The first failure is kept, and nothing is made after
// it: make what is needed, then ask status() once.
#pragma once

#include "lab/host/vulkan_image.hpp"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rebound::engine {

using host::structure;

inline constexpr int framesInFlight = 2;

class Objects {
public:
    explicit Objects(const host::VulkanContext& c) : context(c) {}
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;
    ~Objects();

    // Such as make(vkCreateSampler, vkDestroySampler, info, "creating a sampler").
    template <class Handle, class Info>
    Handle make(VkResult(VKAPI_PTR* create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                void(VKAPI_PTR* destroy)(VkDevice, Handle, const VkAllocationCallbacks*), const Info& info,
                const char* what) {
        Handle handle = VK_NULL_HANDLE;
        if (failed() || !(made = host::check(create(context.device(), &info, nullptr, &handle), what)))
            return VK_NULL_HANDLE;
        destructors.push_back(
            [device = context.device(), destroy, handle] { destroy(device, handle, nullptr); });
        return handle;
    }

    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkFormat format = VK_FORMAT_UNDEFINED;
        Extent2D extent;
    };
    Image image(Extent2D, VkFormat, VkImageUsageFlags, VkImageAspectFlags = VK_IMAGE_ASPECT_COLOR_BIT);
    // On the device, holding these bytes.
    VkBuffer buffer(std::span<const std::byte>, VkBufferUsageFlags);
    // With these texels, for shaders to sample.
    Image texture(Extent2D, VkFormat, std::span<const std::byte>);
    // For the host to write at any time; null after a failure.
    host::VulkanBuffer* mappedBuffer(VkDeviceSize, VkBufferUsageFlags);

    VkDescriptorSetLayout setLayout(std::initializer_list<VkDescriptorType>, VkShaderStageFlags);
    VkDescriptorPool descriptorPool(uint32_t sets, std::initializer_list<VkDescriptorPoolSize>);
    VkDescriptorSet descriptorSet(VkDescriptorPool, VkDescriptorSetLayout);
    VkPipelineLayout pipelineLayout(std::initializer_list<VkDescriptorSetLayout>,
                                    VkShaderStageFlags pushStages = 0, uint32_t pushSize = 0);
    VkSampler sampler(VkFilter, VkSamplerAddressMode u, VkSamplerAddressMode v);

    void fail(Error error) { made = std::move(error); }
    bool failed() const { return !made; }
    const Result<>& status() const { return made; }

private:
    template <class T>
    T* keep(Result<std::unique_ptr<T>> object);

    const host::VulkanContext& context;
    Result<> made;
    std::vector<std::function<void()>> destructors;
};

// Writes one descriptor of an image or of a buffer.
void writeImage(VkDevice, VkDescriptorSet, uint32_t binding, VkDescriptorType, VkSampler, VkImageView,
                VkImageLayout);
void writeBuffer(VkDevice, VkDescriptorSet, uint32_t binding, VkDescriptorType, VkBuffer, VkDeviceSize size);

} // namespace rebound::engine
