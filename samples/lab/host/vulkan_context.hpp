// SPDX-License-Identifier: MIT
// What a host without a window has: an instance, a device, a queue, and validation's messages.
#pragma once

#include "rebound/result.hpp"

#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rebound::host {

struct VulkanOptions {
    std::string
        device; // part of its name; empty: the first, discrete ones before integrated ones before software
    bool validation = false; // with synchronization validation; fails where the layer is not installed
    std::vector<const char*> instanceExtensions, deviceExtensions;
};

class VulkanContext {
public:
    static Result<VulkanContext> create(const VulkanOptions& = {});

    VkInstance instance() const { return state->instance; }
    VkPhysicalDevice physicalDevice() const { return state->physicalDevice; }
    VkDevice device() const { return state->device; }
    VkQueue queue() const { return state->queue; }
    uint32_t queueFamily() const { return state->queueFamily; } // computes, and draws where the device does
    bool hasDebugUtils() const { return state->messenger != VK_NULL_HANDLE; }
    const std::string& deviceName() const { return state->deviceName; }

    // Records commands, submits them, and waits until the GPU is done.
    Result<> run(const std::function<Result<>(VkCommandBuffer)>& record) const;

    // A type of memory with these properties among the allowed ones, or -1.
    int memoryType(uint32_t allowed, VkMemoryPropertyFlags) const;

    // What validation has said so far, warnings and errors.
    const std::vector<std::string>& messages() const { return state->messages; }

private:
    struct State {
        VkInstance instance = VK_NULL_HANDLE;
        VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
        VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
        VkDevice device = VK_NULL_HANDLE;
        VkQueue queue = VK_NULL_HANDLE;
        uint32_t queueFamily = 0;
        VkCommandPool pool = VK_NULL_HANDLE;
        std::string deviceName;
        std::vector<std::string> messages;

        State() = default;
        State(const State&) = delete;
        State& operator=(const State&) = delete;
        ~State();
    };
    static Result<> createInstance(const VulkanOptions&, State&);
    static Result<> chooseDevice(const VulkanOptions&, State&);
    static Result<> createDevice(const VulkanOptions&, State&);

    std::unique_ptr<State> state;
};

// An empty structure of Vulkan's, with its type.
template <class T>
T structure(VkStructureType type) {
    T value{};
    value.sType = type;
    return value;
}

// An error of a call, or success.
Result<> check(VkResult, const char* what);

} // namespace rebound::host
