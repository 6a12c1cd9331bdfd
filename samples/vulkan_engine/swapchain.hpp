// SPDX-License-Identifier: MIT
// A swapchain and the pass that shows a picture on it.
#pragma once

#include "passes.hpp"

#include <memory>
#include <optional>

namespace rebound::engine {

class Swapchain {
public:
    // Once for a surface: what does not depend on the window's size. The context and the surface outlive it.
    static Result<std::unique_ptr<Swapchain>> create(const host::VulkanContext&, VkSurfaceKHR);
    ~Swapchain();

    // Waits until nothing is shown any more: presenting has no fence in Vulkan 1.1.
    Result<> resize(Extent2D wanted);
    Extent2D extent() const { return size; }

    // Shows composed, in layout GENERAL and readable by fragment shaders, through the lab's tone curve. The frame's number
    // is that of Renderer::record().
    void recordPresent(VkCommandBuffer, int frame, uint32_t image, const Objects::Image& composed,
                       float exposure) const;

    // The next image, or none where the swapchain has to be made anew. `available` is signalled once it may be drawn to.
    Result<std::optional<uint32_t>> acquire(VkSemaphore available) const;
    // To be signalled once the image has been drawn; one an image, as an image comes back when its presentation is over.
    VkSemaphore drawn(uint32_t image) const { return semaphores[image]; }
    // Shows it once it has been drawn. False where the swapchain has to be made anew.
    Result<bool> present(uint32_t image) const;

private:
    Swapchain(const host::VulkanContext& c, VkSurfaceKHR s) : context(c), surface(s), objects(c) {}
    Result<> createOnce();
    Result<> makeFramebuffers();

    const host::VulkanContext& context;
    VkSurfaceKHR surface;
    VkSurfaceFormatKHR format{};
    Objects objects;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet sets[framesInFlight] = {};
    Extent2D size;
    VkSwapchainKHR chain = VK_NULL_HANDLE;
    std::unique_ptr<Objects> sized; // by image: views, and these
    std::vector<VkFramebuffer> framebuffers;
    std::vector<VkSemaphore> semaphores;
};

} // namespace rebound::engine
