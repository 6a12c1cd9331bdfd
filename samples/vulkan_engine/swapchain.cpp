// SPDX-License-Identifier: MIT
#include "swapchain.hpp"

#include "present_frag.h"
#include "present_vert.h"

#include <algorithm>

namespace rebound::engine {
namespace {

// One colour attachment that is shown.
VkRenderPass makePresentPass(Objects& objects, VkFormat format) {
    const VkAttachmentDescription attachment{0,
                                             format,
                                             VK_SAMPLE_COUNT_1_BIT,
                                             VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                             VK_ATTACHMENT_STORE_OP_STORE,
                                             VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                             VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                             VK_IMAGE_LAYOUT_UNDEFINED,
                                             VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    // The layout changes once the image is available: that semaphore is waited for at this stage.
    constexpr VkPipelineStageFlags stage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    const VkSubpassDependency dependency{
        VK_SUBPASS_EXTERNAL, 0, stage, stage, 0, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0};
    auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &dependency;
    return objects.make(vkCreateRenderPass, vkDestroyRenderPass, info, "creating a render pass");
}

} // namespace

Result<std::unique_ptr<Swapchain>> Swapchain::create(const host::VulkanContext& context,
                                                     VkSurfaceKHR surface) {
    std::unique_ptr<Swapchain> swapchain(new Swapchain(context, surface));
    if (auto made = swapchain->createOnce(); !made) return made.error();
    return swapchain;
}

Swapchain::~Swapchain() {
    sized.reset();
    if (chain) vkDestroySwapchainKHR(context.device(), chain, nullptr);
}

Result<> Swapchain::createOnce() {
    VkBool32 presents = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(context.physicalDevice(), context.queueFamily(), surface, &presents);
    if (!presents)
        return Error{ErrorCode::unsupported,
                     "--window: " + context.deviceName() + " cannot show pictures in this window"};
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(context.physicalDevice(), surface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(context.physicalDevice(), surface, &count, formats.data());
    const auto found = std::find_if(formats.begin(), formats.end(), [](const VkSurfaceFormatKHR& f) {
        return f.format == VK_FORMAT_B8G8R8A8_SRGB || f.format == VK_FORMAT_R8G8B8A8_SRGB;
    });
    if (found == formats.end())
        return Error{ErrorCode::unsupported, "--window: the window has no format of 8 bits in sRGB"};
    format = *found;
    pass = makePresentPass(objects, format.format);
    sampler = objects.sampler(VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                              VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    constexpr VkDescriptorType sampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    const VkDescriptorSetLayout setLayout = objects.setLayout({sampled}, VK_SHADER_STAGE_FRAGMENT_BIT);
    const VkDescriptorPool pool = objects.descriptorPool(framesInFlight, {{sampled, framesInFlight}});
    for (VkDescriptorSet& set : sets) set = objects.descriptorSet(pool, setLayout);
    layout = objects.pipelineLayout({setLayout}, VK_SHADER_STAGE_FRAGMENT_BIT, sizeof(float));
    pipeline =
        makePipeline(objects, {present_vert, present_frag, layout, pass, 1, VK_COMPARE_OP_ALWAYS, false});
    return objects.status();
}

Result<> Swapchain::resize(Extent2D wanted) {
    VkSurfaceCapabilitiesKHR can;
    if (auto asked =
            host::check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(context.physicalDevice(), surface, &can),
                        "asking for the window's size");
        !asked)
        return asked;
    const auto within = [](int side, uint32_t least, uint32_t most) {
        return int(std::clamp(uint32_t(side), least, most));
    };
    size = {within(wanted.width, can.minImageExtent.width, can.maxImageExtent.width),
            within(wanted.height, can.minImageExtent.height, can.maxImageExtent.height)};
    auto info = structure<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
    info.surface = surface;
    info.minImageCount =
        can.maxImageCount > 0 ? std::min(can.minImageCount + 1, can.maxImageCount) : can.minImageCount + 1;
    info.imageFormat = format.format;
    info.imageColorSpace = format.colorSpace;
    info.imageExtent = {uint32_t(size.width), uint32_t(size.height)};
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = chain;
    VkSwapchainKHR next = VK_NULL_HANDLE;
    auto made =
        host::check(vkCreateSwapchainKHR(context.device(), &info, nullptr, &next), "creating a swapchain");
    if (!made) return made;
    vkDeviceWaitIdle(context.device());
    sized = std::make_unique<Objects>(context);
    if (chain) vkDestroySwapchainKHR(context.device(), chain, nullptr);
    chain = next;
    return makeFramebuffers();
}

Result<> Swapchain::makeFramebuffers() {
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(context.device(), chain, &count, nullptr);
    std::vector<VkImage> images(count);
    vkGetSwapchainImagesKHR(context.device(), chain, &count, images.data());
    framebuffers.clear();
    semaphores.clear();
    for (VkImage image : images) {
        auto viewInfo = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
        viewInfo.image = image;
        viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
        viewInfo.format = format.format;
        viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        const VkImageView view =
            sized->make(vkCreateImageView, vkDestroyImageView, viewInfo, "creating an image view");
        framebuffers.push_back(
            makeFramebuffer(*sized, pass, {Objects::Image{image, view, format.format, size}}));
        const auto semaphoreInfo = structure<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
        semaphores.push_back(
            sized->make(vkCreateSemaphore, vkDestroySemaphore, semaphoreInfo, "creating a semaphore"));
    }
    return sized->status();
}

void Swapchain::recordPresent(VkCommandBuffer commands, int frame, uint32_t image,
                              const Objects::Image& composed, float exposure) const {
    const VkDescriptorSet set = sets[frame];
    writeImage(context.device(), set, 0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, sampler, composed.view,
               VK_IMAGE_LAYOUT_GENERAL);
    auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = pass;
    begin.framebuffer = framebuffers[image];
    begin.renderArea.extent = {uint32_t(size.width), uint32_t(size.height)};
    const VkViewport viewport{0, 0, float(size.width), float(size.height), 0.0f, 1.0f};
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &begin.renderArea);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, nullptr);
    vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof exposure, &exposure);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRenderPass(commands);
}

Result<std::optional<uint32_t>> Swapchain::acquire(VkSemaphore available) const {
    uint32_t image = 0;
    const VkResult result =
        vkAcquireNextImageKHR(context.device(), chain, UINT64_MAX, available, VK_NULL_HANDLE, &image);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return std::optional<uint32_t>();
    if (result != VK_SUBOPTIMAL_KHR)
        if (auto acquired = host::check(result, "acquiring an image of the window"); !acquired)
            return acquired.error();
    return std::optional(image);
}

Result<bool> Swapchain::present(uint32_t image) const {
    auto info = structure<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &semaphores[image];
    info.swapchainCount = 1;
    info.pSwapchains = &chain;
    info.pImageIndices = &image;
    const VkResult result = vkQueuePresentKHR(context.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
    if (auto presented = host::check(result, "showing an image"); !presented) return presented.error();
    return true;
}

} // namespace rebound::engine
