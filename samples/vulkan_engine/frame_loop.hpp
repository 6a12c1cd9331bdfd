// SPDX-License-Identifier: MIT
// Frames in flight: a command buffer and a fence each.
#pragma once

#include "objects.hpp"

namespace rebound::engine {

class FrameLoop {
public:
    // The context outlives it.
    static Result<std::unique_ptr<FrameLoop>> create(const host::VulkanContext&);
    ~FrameLoop(); // waits for all frames

    // Waits until the GPU is done with the frame before of this number, and begins its command buffer.
    Result<VkCommandBuffer> begin();
    int frame() const { return current; }
    // Submits it, behind `wait` and signalling `signal` unless they are null, and goes on to the next frame.
    Result<> submit(VkSemaphore wait = VK_NULL_HANDLE, VkSemaphore signal = VK_NULL_HANDLE);
    // Instead of submit(): this frame is not to be, and its number comes again.
    void abandon() { vkEndCommandBuffer(commands[current]); }
    // Signalled by whoever provides what this frame draws to.
    VkSemaphore available() const { return semaphores[current]; }

private:
    explicit FrameLoop(const host::VulkanContext& c) : context(c), objects(c) {}
    const host::VulkanContext& context;
    Objects objects;
    VkCommandBuffer commands[framesInFlight] = {};
    VkFence fences[framesInFlight] = {};
    VkSemaphore semaphores[framesInFlight] = {};
    int current = 0;
};

} // namespace rebound::engine
