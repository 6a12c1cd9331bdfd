// SPDX-License-Identifier: MIT
// What a device and its programs consist of.
#pragma once

#include "functions.hpp"
#include "rebound/detail/loss.hpp"
#include "rebound/vulkan/device.hpp"

#include <array>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace rebound::vulkan {

// A shader with the layout of its slots, and a pipeline for each set of features that was asked for.
struct Kernel {
    VkShaderModule module = VK_NULL_HANDLE;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::map<std::vector<int>, VkPipeline> pipelines;
};

struct Device::Shared {
    Functions vk;
    VkDevice device = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memoryTypes{};
    uint32_t timestampBits = 0; // 0: no timings
    MemoryAllocator allocator;
    std::vector<std::span<const Shader* const>> shaders;
    VkSampler sampler = VK_NULL_HANDLE;
    VkPipelineCache cache = VK_NULL_HANDLE;

    std::mutex mutex; // guards kernels
    std::map<const Shader*, Kernel> kernels;

    mutable detail::Loss loss;

    Shared() = default;
    Shared(const Shared&) = delete;
    Shared& operator=(const Shared&) = delete;
    ~Shared();

    // An error of a call that does what is said, or success. A lost device is lost from then on.
    Result<> check(VkResult, const std::string& what) const;
    void setName(VkObjectType, uint64_t handle, const std::string&) const;
};

template <class Handle>
uint64_t handleBits(Handle handle) {
    if constexpr (std::is_pointer_v<Handle>) return reinterpret_cast<uint64_t>(handle);
    else return uint64_t(handle);
}

constexpr VkDescriptorType descriptorType(BindingKind kind) {
    switch (kind) {
    case BindingKind::image:
    case BindingKind::output:
        return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case BindingKind::buffer:
    case BindingKind::values:
    case BindingKind::outputValues:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::constants:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    default:
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
}

// Memory that goes back where it came from.
struct OwnedMemory {
    std::shared_ptr<const Device::Shared> device;
    MemoryBlock block;
    VkDeviceSize size = 0;

    OwnedMemory() = default;
    OwnedMemory(const OwnedMemory&) = delete;
    OwnedMemory& operator=(const OwnedMemory&) = delete;
    ~OwnedMemory();
};
Result<std::shared_ptr<OwnedMemory>> allocateMemory(const std::shared_ptr<const Device::Shared>&,
                                                    const MemoryRequest&);

// Without memory yet, or bound to some.
struct OwnImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkMemoryRequirements requirements{};
};
struct OwnBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkMemoryRequirements requirements{};
};

// The transients of a plan, and where each lies in the block that they share.
struct Transients {
    std::vector<OwnImage> images;   // by resource; null where it is no transient that passes use
    std::vector<OwnBuffer> buffers; // likewise
    TransientLayout layout;
    VkMemoryRequirements block{}; // what the shared block needs; its size is 0 where there is none

    size_t sizeOf(ResourceIndex r) const { // 0 where it is no transient that passes use
        return size_t(images[size_t(r)].requirements.size + buffers[size_t(r)].requirements.size);
    }
};

// What a program keeps from frame to frame, and where each lies in one block.
struct Persistent {
    std::vector<std::array<OwnImage, 2>> images;      // by resource; of history
    std::vector<OwnBuffer> buffers;                   // by resource
    std::vector<std::array<VkDeviceSize, 2>> offsets; // by resource; of history two [bytes]
    VkMemoryRequirements block{};
};

// Where a plan's buffers and frame constants lie in one host-visible buffer.
struct BufferLayout {
    std::vector<VkDeviceSize> offsets; // by resource; of frame constants, in frame 0 [bytes]
    VkDeviceSize frameOffset = 0;      // where the constants of frame 0 begin [bytes]
    VkDeviceSize frameStride = 0;      // from one frame's constants to the next [bytes]
    VkDeviceSize size = 0;             // [bytes]
};

struct CompiledPass {
    const Kernel* kernel = nullptr;
    VkPipeline pipeline = VK_NULL_HANDLE;
    GroupCounts groups;
    std::vector<PassBinding> perFrame;    // bound by record(): what is the host's, and history
    bool barrier = false;                 // whether earlier passes have to be done
    std::vector<ResourceIndex> beginning; // transients whose contents are given up before this pass
};

struct Program::State {
    std::shared_ptr<Device::Shared> device;
    Plan plan;
    MemoryUse use;
    int framesInFlight = 0;
    bool inspectable = false;
    std::shared_ptr<OwnedMemory> transientMemory;
    Transients transients;
    std::shared_ptr<OwnedMemory> persistentMemory;
    Persistent persistent;
    detail::FrameCount frames;
    int historyWritten = 0; // the image of history that the latest frame writes
    std::shared_ptr<OwnedMemory> bufferMemory;
    BufferLayout bufferLayout;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDescriptorPool descriptorPool = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> sets;    // frame * passes + pass
    VkQueryPool queries = VK_NULL_HANDLE; // frame * (passes + 1) + pass: its beginning; one more: the end
    std::vector<int> measured;            // frames whose queries were recorded, the latest last
    std::vector<CompiledPass> passes;
    std::function<void(VkCommandBuffer, int)> passCallback;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();
};

// pipelines.cpp
Result<const Kernel*> obtainKernel(Device::Shared&, const Shader&);
Result<VkPipeline> obtainPipeline(Device::Shared&, const Shader&, const std::vector<int>& features);

// resources.cpp
Result<Transients> createTransients(const Device::Shared&, const Plan&, bool inspectable);
void destroy(const Device::Shared&, Transients&);
Result<Persistent> createPersistent(const Device::Shared&, const Plan&, bool inspectable);
void destroy(const Device::Shared&, Persistent&);
// To memory from an offset on; and a view of it.
Result<> bindImage(const Device::Shared&, const Resource&, const OwnedMemory&, VkDeviceSize offset,
                   OwnImage&);
Result<> bindBuffer(const Device::Shared&, const std::string& name, const OwnedMemory&, VkDeviceSize offset,
                    const OwnBuffer&);
Result<OwnBuffer> createOwnBuffer(const Device::Shared&, const std::string& name, VkDeviceSize size,
                                  VkBufferUsageFlags);
BufferLayout layoutBuffers(const Device::Shared&, const Plan&, int framesInFlight);

// schedule.cpp
// Where barriers go, and where each transient begins its life.
void schedulePasses(const Plan&, const Transients&, bool separate, std::vector<CompiledPass>&);

} // namespace rebound::vulkan
