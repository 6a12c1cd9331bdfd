// SPDX-License-Identifier: MIT
#include "lab/host/vulkan_context.hpp"

#include <algorithm>
#include <cstring>

namespace rebound::host {
namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                           VkDebugUtilsMessageTypeFlagsEXT,
                                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
    static_cast<std::vector<std::string>*>(messages)->push_back(data->pMessage);
    return VK_FALSE;
}

bool isLayerPresent(const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(std::vector<std::string>& messages) {
    auto info = structure<VkDebugUtilsMessengerCreateInfoEXT>(
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Not general messages: there the loader reports drivers that cannot be loaded. Nor advice on performance: copies
    // for inspection leave images in layout GENERAL.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = keepMessage;
    info.pUserData = &messages;
    return info;
}

template <class Function>
Function instanceFunction(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

// The family that draws and computes, or else one that computes.
int queueFamilyOf(VkPhysicalDevice device) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (VkQueueFlags wanted :
         {VkQueueFlags(VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT), VkQueueFlags(VK_QUEUE_COMPUTE_BIT)})
        for (uint32_t i = 0; i < count; ++i)
            if ((families[i].queueFlags & wanted) == wanted) return int(i);
    return -1;
}

int rankOf(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    default:
        return 3;
    }
}

} // namespace

Result<> check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return {};
    const ErrorCode code = result == VK_ERROR_DEVICE_LOST ? ErrorCode::deviceLost
                           : result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY
                               ? ErrorCode::outOfMemory
                               : ErrorCode::unsupported;
    return Error{code,
                 std::string("Vulkan: ") + what + " failed with VkResult " + std::to_string(int(result))};
}

VulkanContext::State::~State() {
    if (device) {
        vkDeviceWaitIdle(device);
        if (pool) vkDestroyCommandPool(device, pool, nullptr);
        vkDestroyDevice(device, nullptr);
    }
    if (messenger)
        instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(instance, "vkDestroyDebugUtilsMessengerEXT")(
            instance, messenger, nullptr);
    if (instance) vkDestroyInstance(instance, nullptr);
}

Result<> VulkanContext::createInstance(const VulkanOptions& options, State& s) {
    if (options.validation && !isLayerPresent(validationLayer))
        return Error{ErrorCode::unsupported,
                     std::string("validation: the layer ") + validationLayer + " is not installed"};
    auto application = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "Rebound";
    application.apiVersion = VK_API_VERSION_1_1;
    std::vector<const char*> extensions = options.instanceExtensions;
    const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    auto features = structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;
    auto messenger = messengerInfo(s.messages);
    messenger.pNext = &features;
    auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    if (options.validation) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validationLayer;
        info.pNext = &messenger;
    }
    info.enabledExtensionCount = uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (auto made = check(vkCreateInstance(&info, nullptr, &s.instance), "creating an instance"); !made)
        return made;
    if (!options.validation) return {};
    const auto create =
        instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>(s.instance, "vkCreateDebugUtilsMessengerEXT");
    const auto plain = messengerInfo(s.messages);
    return check(create(s.instance, &plain, nullptr, &s.messenger), "creating a debug messenger");
}

Result<> VulkanContext::chooseDevice(const VulkanOptions& options, State& s) {
    uint32_t count = 0;
    vkEnumeratePhysicalDevices(s.instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(s.instance, &count, devices.data());
    int best = 4;
    std::string known;
    for (VkPhysicalDevice device : devices) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(device, &properties);
        const std::string name = properties.deviceName;
        known += (known.empty() ? "" : ", ") + name;
        const int family = queueFamilyOf(device), rank = rankOf(properties.deviceType);
        if (family < 0 || properties.apiVersion < VK_API_VERSION_1_1 || rank >= best ||
            name.find(options.device) == std::string::npos)
            continue;
        best = rank;
        s.physicalDevice = device;
        s.queueFamily = uint32_t(family);
        s.deviceName = name;
    }
    if (s.physicalDevice) return {};
    return Error{ErrorCode::notFound,
                 "Vulkan: no device" +
                     (options.device.empty() ? "" : " whose name holds \"" + options.device + "\"") +
                     " with Vulkan 1.1 and a queue that computes was found" +
                     (known.empty() ? "; there is none at all" : "; there are " + known)};
}

Result<> VulkanContext::createDevice(const VulkanOptions& options, State& s) {
    const float priority = 1.0f;
    auto queue = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = s.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = uint32_t(options.deviceExtensions.size());
    info.ppEnabledExtensionNames = options.deviceExtensions.data();
    if (auto made = check(vkCreateDevice(s.physicalDevice, &info, nullptr, &s.device), "creating a device");
        !made)
        return made;
    vkGetDeviceQueue(s.device, s.queueFamily, 0, &s.queue);
    auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = s.queueFamily;
    return check(vkCreateCommandPool(s.device, &pool, nullptr, &s.pool), "creating a command pool");
}

Result<VulkanContext> VulkanContext::create(const VulkanOptions& options) {
    VulkanContext context;
    context.state = std::make_unique<State>();
    if (auto made = createInstance(options, *context.state); !made) return made.error();
    if (auto found = chooseDevice(options, *context.state); !found) return found.error();
    if (auto made = createDevice(options, *context.state); !made) return made.error();
    return context;
}

Result<> VulkanContext::run(const std::function<Result<>(VkCommandBuffer)>& record) const {
    auto allocation = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = state->pool;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    if (auto made = check(vkAllocateCommandBuffers(state->device, &allocation, &commands),
                          "allocating a command buffer");
        !made)
        return made;
    auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    Result<> done = check(vkBeginCommandBuffer(commands, &begin), "beginning a command buffer");
    if (done) done = record(commands);
    if (done) done = check(vkEndCommandBuffer(commands), "ending a command buffer");
    auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    if (done) done = check(vkQueueSubmit(state->queue, 1, &submit, VK_NULL_HANDLE), "submitting");
    if (done) done = check(vkQueueWaitIdle(state->queue), "waiting for the queue");
    vkFreeCommandBuffers(state->device, state->pool, 1, &commands);
    return done;
}

int VulkanContext::memoryType(uint32_t allowed, VkMemoryPropertyFlags flags) const {
    VkPhysicalDeviceMemoryProperties types;
    vkGetPhysicalDeviceMemoryProperties(state->physicalDevice, &types);
    for (uint32_t i = 0; i < types.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (types.memoryTypes[i].propertyFlags & flags) == flags) return int(i);
    return -1;
}

} // namespace rebound::host
