// SPDX-License-Identifier: MIT
// The Vulkan backend: records plans into the host's command buffers.
#pragma once

#include "rebound/device.hpp"
#include "rebound/shaders.hpp"
#include "rebound/vulkan/memory.hpp"

#include <vulkan/vulkan_core.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rebound::vulkan {

// A buffer of the host, with usage STORAGE_BUFFER; an input buffer's contents are available to compute shaders' reads before
// the commands of record() run, an output buffer's to writes, and afterwards it has been written by compute shaders.
struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;      // a multiple of minStorageBufferOffsetAlignment [bytes]
    VkDeviceSize size = 0;        // from there on; at least the plan's resource's [bytes]
    std::shared_ptr<void> shared; // of Device::createBuffer(): keeps buffer and memory
};

// An image of the host. Before the commands of record() run, its contents have to be available to compute shaders (an
// input to reads, an output to writes), in the layout given here; Rebound never changes it. Afterwards outputs have been
// written by compute shaders: the host's next barrier waits for stage COMPUTE_SHADER, access SHADER_WRITE.
struct Image {
    using Buffer = vulkan::Buffer;

    VkImageView view = VK_NULL_HANDLE;     // 2D, of one aspect; usage SAMPLED (inputs), STORAGE and, as later
                                           // passes may read them, SAMPLED (outputs)
    Extent2D extent;                       // of the image
    VkFormat format = VK_FORMAT_UNDEFINED; // of outputs: that of the plan's resource; of inputs: any that
                                           // shaders sample as floats, and not looked at
    VkImageLayout layout =
        VK_IMAGE_LAYOUT_GENERAL; // of inputs: any in which shaders read; of outputs: GENERAL
};

// The format of a plan's resource.
VkFormat vulkanFormat(Format);

// The host's own objects, which outlive the device and its programs. Vulkan 1.1, no extension.
struct DeviceOptions {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr; // Vulkan is reached through it alone
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    uint32_t queueFamily = 0;  // of the command buffers: a family that computes
    MemoryAllocator allocator; // the host's; empty: one vkAllocateMemory for a program's transients
                               // one for its buffers, and one for what it keeps from frame to frame
    std::span<const std::byte> pipelineCache; // what pipelineCache() gave in an earlier run; may be empty,
                                              // stale or spoilt: then it is left out
    bool timings = false;                     // whether programs measure their passes
    bool debugUtils = false; // the host has enabled VK_EXT_debug_utils: name objects, label passes
    // Shaders beside the techniques' own, of an engine that writes some; looked up first.
    std::vector<std::span<const Shader* const>> moreShaders;
};

class Program;

struct CompileOptions {
    int framesInFlight = 2; // 1 to 8: how many recordings may be in use by the GPU at once
    // Use that program's memory for transients: for several views, or for the successor of a program that is still in
    // flight. Both are to be recorded for the same queue. Fails where that memory is too small: begin with the largest.
    const Program* shareTransientsWith = nullptr;
    bool inspectable = false; // the device's own images and buffers can be copied from and to: see ownImage()
};

// Once a call has failed with deviceLost, every call of this device and of its programs that can fail does at once, with
// the same words, and calls nothing of Vulkan: destroy all of them, which is safe, and the host's device.
class Device {
public:
    // Fails where a handle is null, or the device or the queue family cannot do what Rebound needs.
    static Result<Device> create(const DeviceOptions&);

    // Fails where the plan is not valid, names a kernel, slot or feature that does not exist, exceeds the device's
    // limits, or memory is short; the device stays as it was. May be called from several threads.
    Result<Program> compile(const Plan&, const CompileOptions& = {}) const;

    // What compile() would allocate, alignment and padding of the driver included.
    Result<MemoryUse> memoryUse(const Plan&, const CompileOptions& = {}) const;

    // An input buffer that any number of programs are handed in each frame, with one upload of the data, to memory that the
    // host sees: DEVICE_LOCAL too where the GPU has such. Where it has none, a host that can submit a copy of megabytes to
    // faster memory hands in a buffer of its own instead. It lives as long as a copy of the handle.
    Result<Buffer> createBuffer(std::span<const std::byte>) const;

    // The driver's compiled pipelines and a checksum, for DeviceOptions::pipelineCache of a later run.
    Result<std::vector<std::byte>> pipelineCache() const;

    struct Shared;

private:
    std::shared_ptr<Shared> shared;
};

// A compiled plan. Destroy it when the GPU is done with what it recorded: after a resize, keep the old program until then.
// Not to be recorded from two threads at once.
class Program {
public:
    // Records one frame; submits nothing, and waits for nothing. frame: 0 to framesInFlight - 1; the GPU has to be done
    // with the commands that were last recorded for it. The command buffer is in the recording state, outside of a render
    // pass. Fails, and records nothing, where an image or constant of the plan is missing, unknown, null, of another size
    // or, an output, of another format. What is recorded is to be submitted, once and in order: the next frame reads its history.
    Result<> record(VkCommandBuffer, int frame, const FrameInputs<Image>&);

    // The next frame is a first one: history and persistent buffers hold zeros, and FrameState says so.
    void reset();

    // Of the latest frame that the GPU has finished, a pass each in the plan's order; empty before that, and where timings
    // were not asked for or the queue family has no timestamps. Waits for nothing. Passes are kept apart by barriers while
    // they are measured.
    Result<std::vector<PassTiming>> timings() const;

    const Plan& plan() const;
    MemoryUse memoryUse() const;

    // Of an inspectable program: an image of the device's own, of history the one that the latest frame writes. A transient
    // holds what passes wrote until another one takes its memory. Its layout is GENERAL.
    Result<VkImage> ownImage(std::string_view name) const;
    // The same of a transient or persistent buffer.
    Result<Buffer> ownBuffer(std::string_view name) const;
    // Called while record() records, behind each pass, with its index; empty: never. It may record commands, and has to
    // order them against the compute shaders before and behind.
    void onPass(std::function<void(VkCommandBuffer, int)> callback);

    struct State;
    explicit Program(std::unique_ptr<State>);
    ~Program();
    Program(Program&&) noexcept;
    Program& operator=(Program&&) noexcept;

private:
    friend class Device;
    std::unique_ptr<State> state;
};

} // namespace rebound::vulkan
