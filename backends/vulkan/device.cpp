// SPDX-License-Identifier: MIT
#include "device_state.hpp"

#include "rebound/detail/shader_check.hpp"

#include <cstring>

namespace rebound::vulkan {
namespace {

// The name of a result that says that something is short; null of others.
const char* shortageOf(VkResult result) {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_FRAGMENTED_POOL:
        return "VK_ERROR_FRAGMENTED_POOL";
    case VK_ERROR_MEMORY_MAP_FAILED:
        return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return "VK_ERROR_OUT_OF_POOL_MEMORY";
    default:
        return nullptr;
    }
}

Result<> checkHandles(const DeviceOptions& o) {
    const std::pair<const char*, bool> handles[] = {{"getInstanceProcAddr", o.getInstanceProcAddr != nullptr},
                                                    {"instance", o.instance != VK_NULL_HANDLE},
                                                    {"physicalDevice", o.physicalDevice != VK_NULL_HANDLE},
                                                    {"device", o.device != VK_NULL_HANDLE}};
    for (const auto& handle : handles)
        if (!handle.second) return invalidArgument(std::string(handle.first) + " is null");
    if (bool(o.allocator.allocate) != bool(o.allocator.free))
        return invalidArgument("allocator has one of allocate and free; both or neither were expected");
    return {};
}

Result<VkQueueFamilyProperties> queueFamilyOf(const Functions& vk, const DeviceOptions& o) {
    uint32_t count = 0;
    vk.GetPhysicalDeviceQueueFamilyProperties(o.physicalDevice, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.GetPhysicalDeviceQueueFamilyProperties(o.physicalDevice, &count, families.data());
    if (o.queueFamily >= count)
        return invalidArgument("queueFamily is " + std::to_string(o.queueFamily) + "; 0 to " +
                               std::to_string(count - 1) + " was expected");
    if (!(families[o.queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT))
        return Error{ErrorCode::unsupported,
                     "queueFamily " + std::to_string(o.queueFamily) +
                         " does not compute; one with VK_QUEUE_COMPUTE_BIT was expected"};
    return families[o.queueFamily];
}

Result<> createSampler(Device::Shared& d) {
    // Kernels fetch texels; the sampler is there since the language's textures have one.
    auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return d.check(d.vk.CreateSampler(d.device, &info, nullptr, &d.sampler), "creating a sampler");
}

// FNV-1a, behind the driver's bytes: a file that was cut or spoilt is not for drivers, some of which trust it.
uint64_t checksumOf(std::span<const std::byte> bytes) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (std::byte b : bytes) hash = (hash ^ uint64_t(b)) * 0x100000001b3u;
    return hash;
}

// The driver's bytes of a stored cache; none where it is spoilt, or was made by another driver or for another device:
// those are refused by some drivers, and crash some.
std::span<const std::byte> storedCache(std::span<const std::byte> bytes,
                                       const VkPhysicalDeviceProperties& properties) {
    VkPipelineCacheHeaderVersionOne header;
    uint64_t checksum = 0;
    if (bytes.size() < sizeof header + sizeof checksum) return {};
    const auto driverBytes = bytes.first(bytes.size() - sizeof checksum);
    std::memcpy(&header, driverBytes.data(), sizeof header);
    std::memcpy(&checksum, driverBytes.data() + driverBytes.size(), sizeof checksum);
    const bool usable =
        header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
        header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
        std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0 &&
        checksum == checksumOf(driverBytes);
    return usable ? driverBytes : std::span<const std::byte>();
}

Result<> createCache(Device::Shared& d, std::span<const std::byte> bytes,
                     const VkPhysicalDeviceProperties& properties) {
    auto info = structure<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    const auto stored = storedCache(bytes, properties);
    info.initialDataSize = stored.size();
    info.pInitialData = stored.data();
    return d.check(d.vk.CreatePipelineCache(d.device, &info, nullptr, &d.cache), "creating a pipeline cache");
}

} // namespace

Result<> Device::Shared::check(VkResult result, const std::string& what) const {
    if (result == VK_SUCCESS) return {};
    if (result == VK_ERROR_DEVICE_LOST)
        return loss.note(
            what +
            " failed with VK_ERROR_DEVICE_LOST: the device is lost, and what was made with it can only be "
            "destroyed");
    const char* name = shortageOf(result);
    return Error{name ? ErrorCode::outOfMemory : ErrorCode::unsupported,
                 what + " failed with " + (name ? name : "VkResult " + std::to_string(int(result)))};
}

Device::Shared::~Shared() {
    for (auto& [shader, kernel] : kernels) {
        for (auto& [features, pipeline] : kernel.pipelines) vk.DestroyPipeline(device, pipeline, nullptr);
        if (kernel.layout) vk.DestroyPipelineLayout(device, kernel.layout, nullptr);
        if (kernel.setLayout) vk.DestroyDescriptorSetLayout(device, kernel.setLayout, nullptr);
        if (kernel.module) vk.DestroyShaderModule(device, kernel.module, nullptr);
    }
    if (cache) vk.DestroyPipelineCache(device, cache, nullptr);
    if (sampler) vk.DestroySampler(device, sampler, nullptr);
}

void Device::Shared::setName(VkObjectType type, uint64_t handle, const std::string& name) const {
    if (!vk.SetDebugUtilsObjectNameEXT) return;
    auto info = structure<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
    info.objectType = type;
    info.objectHandle = handle;
    const std::string full = "rebound " + name;
    info.pObjectName = full.c_str();
    vk.SetDebugUtilsObjectNameEXT(device, &info);
}

Result<Device> Device::create(const DeviceOptions& options) {
    if (auto valid = checkHandles(options); !valid) return valid.error();
    auto functions =
        Functions::load(options.getInstanceProcAddr, options.instance, options.device, options.debugUtils);
    if (!functions) return functions.error();
    auto shared = std::make_shared<Shared>();
    shared->vk = *functions;
    shared->device = options.device;
    VkPhysicalDeviceProperties properties;
    shared->vk.GetPhysicalDeviceProperties(options.physicalDevice, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_1)
        return Error{
            ErrorCode::unsupported,
            "physicalDevice has Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
                std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + "; 1.1 or later was expected"};
    auto family = queueFamilyOf(shared->vk, options);
    if (!family) return family.error();
    shared->limits = properties.limits;
    shared->vk.GetPhysicalDeviceMemoryProperties(options.physicalDevice, &shared->memoryTypes);
    shared->timestampBits = options.timings ? family->timestampValidBits : 0;
    shared->allocator = options.allocator;
    shared->shaders = options.moreShaders;
    shared->shaders.push_back(techniqueShaders());
    if (auto made = createSampler(*shared); !made) return made.error();
    if (auto made = createCache(*shared, options.pipelineCache, properties); !made) return made.error();
    Device device;
    device.shared = std::move(shared);
    return device;
}

Result<Buffer> Device::createBuffer(std::span<const std::byte> data) const {
    struct Held {
        std::shared_ptr<const Shared> device;
        std::shared_ptr<OwnedMemory> memory;
        OwnBuffer own;

        Held() = default;
        Held(const Held&) = delete;
        Held& operator=(const Held&) = delete;
        ~Held() {
            if (own.buffer) device->vk.DestroyBuffer(device->device, own.buffer, nullptr);
        }
    };
    const Shared& d = *shared;
    if (auto present = d.loss.check(); !present) return present.error();
    if (data.empty()) return invalidArgument("data is empty; at least one byte was expected");
    auto held = std::make_shared<Held>();
    held->device = shared;
    auto own = createOwnBuffer(d, "shared buffer", data.size(), 0);
    if (!own) return own.error();
    held->own = *own;
    auto memory = allocateMemory(shared, {own->requirements, true});
    if (!memory) return memory.error();
    held->memory = *std::move(memory);
    if (auto bound = bindBuffer(d, "a shared buffer", *held->memory, 0, held->own); !bound)
        return bound.error();
    std::memcpy(held->memory->block.mapped, data.data(), data.size());
    return Buffer{held->own.buffer, 0, data.size(), held};
}

Result<std::vector<std::byte>> Device::pipelineCache() const {
    const Shared& d = *shared;
    if (auto present = d.loss.check(); !present) return present.error();
    size_t size = 0;
    if (auto asked = d.check(d.vk.GetPipelineCacheData(d.device, d.cache, &size, nullptr),
                             "reading the pipeline cache");
        !asked)
        return asked.error();
    std::vector<std::byte> bytes(size);
    const VkResult result = d.vk.GetPipelineCacheData(d.device, d.cache, &size, bytes.data());
    // Incomplete: another thread has added to it in between; what was read is valid.
    if (result != VK_INCOMPLETE)
        if (auto read = d.check(result, "reading the pipeline cache"); !read) return read.error();
    bytes.resize(size);
    const uint64_t checksum = checksumOf(bytes);
    bytes.resize(size + sizeof checksum);
    std::memcpy(bytes.data() + size, &checksum, sizeof checksum);
    return bytes;
}

} // namespace rebound::vulkan
