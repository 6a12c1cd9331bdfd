// SPDX-License-Identifier: MIT
#include "frame_loop.hpp"

namespace rebound::engine {

Result<std::unique_ptr<FrameLoop>> FrameLoop::create(const host::VulkanContext& context) {
    std::unique_ptr<FrameLoop> loop(new FrameLoop(context));
    auto poolInfo = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    poolInfo.queueFamilyIndex = context.queueFamily();
    auto allocation = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool =
        loop->objects.make(vkCreateCommandPool, vkDestroyCommandPool, poolInfo, "creating a command pool");
    allocation.commandBufferCount = framesInFlight;
    auto fenceInfo = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    fenceInfo.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    const auto semaphoreInfo = structure<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    for (int i = 0; i < framesInFlight; ++i) {
        loop->fences[i] = loop->objects.make(vkCreateFence, vkDestroyFence, fenceInfo, "creating a fence");
        loop->semaphores[i] =
            loop->objects.make(vkCreateSemaphore, vkDestroySemaphore, semaphoreInfo, "creating a semaphore");
    }
    if (!loop->objects.status()) return loop->objects.status().error();
    if (auto made = host::check(vkAllocateCommandBuffers(context.device(), &allocation, loop->commands),
                                "allocating command buffers");
        !made)
        return made.error();
    return loop;
}

FrameLoop::~FrameLoop() { vkDeviceWaitIdle(context.device()); }

Result<VkCommandBuffer> FrameLoop::begin() {
    const auto info = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    auto begun =
        host::check(vkWaitForFences(context.device(), 1, &fences[current], VK_TRUE, UINT64_MAX), "waiting");
    if (begun)
        begun = host::check(vkBeginCommandBuffer(commands[current], &info), "beginning a command buffer");
    if (!begun) return begun.error();
    return commands[current];
}

Result<> FrameLoop::submit(VkSemaphore wait, VkSemaphore signal) {
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    auto info = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.waitSemaphoreCount = wait ? 1 : 0;
    info.pWaitSemaphores = &wait;
    info.pWaitDstStageMask = &stage;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands[current];
    info.signalSemaphoreCount = signal ? 1 : 0;
    info.pSignalSemaphores = &signal;
    auto done = host::check(vkEndCommandBuffer(commands[current]), "ending a command buffer");
    if (done) done = host::check(vkResetFences(context.device(), 1, &fences[current]), "resetting a fence");
    if (done) done = host::check(vkQueueSubmit(context.queue(), 1, &info, fences[current]), "submitting");
    current = (current + 1) % framesInFlight;
    return done;
}

} // namespace rebound::engine
