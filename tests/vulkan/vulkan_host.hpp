// SPDX-License-Identifier: MIT
// A Vulkan host of a test's own, whose validation has to be silent; images on it, and plans that both devices run.
#pragma once

#include "../unit/kernel_runner.hpp"
#include "interception.hpp"

#include "lab/host/vulkan_image.hpp"
#include "rebound/vulkan/device.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rebound::test {

class VulkanHost {
public:
    static std::unique_ptr<VulkanHost> open();
    ~VulkanHost(); // fails the test for each message of validation, and for each object that is left

    const host::VulkanContext& context() const { return vulkan; }
    // With test kernels, through interceptedProcAddr().
    vulkan::DeviceOptions options() const;
    vulkan::Device device(const vulkan::DeviceOptions&) const;
    vulkan::Device device() const { return device(options()); }
    void checkSilence() const;

private:
    explicit VulkanHost(host::VulkanContext context) : vulkan(std::move(context)) {}
    host::VulkanContext vulkan;
};

using NamedPictures = std::vector<std::pair<std::string, Picture>>;

// The images of a plan's inputs and outputs on the GPU; outputs begin as -1.
class GpuFrame {
public:
    GpuFrame(const VulkanHost&, const Plan&, const NamedPictures& inputs, std::vector<NamedConstants> = {});
    Picture read(const std::string& output) const;

    FrameInputs<vulkan::Image> inputs;

private:
    const VulkanHost& host;
    Plan plan;
    std::vector<std::unique_ptr<host::VulkanImage>> images; // by resource
};

// The plan's output "result".
Picture runOnVulkan(const VulkanHost&, const vulkan::Device&, const Plan&, const NamedPictures&,
                    const std::vector<NamedConstants>& = {});
Picture runOnCpu(const Plan&, const NamedPictures&, const std::vector<NamedConstants>& = {});

// host -> copy -> source -> access -> result, in a mode of the kernel access; frame constants: AccessConstants "grid".
Plan copyPlan(Extent2D, int mode = accessOffset);
NamedConstants accessConstants(Extent2D, ivec2 offset = {2, 1}, int shift = 0, int bias = 0);
// What accessOffset makes of a picture.
Picture shifted(const Picture&, ivec2 offset);
// Whether a device makes of copyPlan() what it should.
bool runsRight(const VulkanHost&, const vulkan::Device&);

} // namespace rebound::test
