// SPDX-License-Identifier: MIT
#include "vulkan_host.hpp"

#include "lab/runner/texels.hpp"

#include <cstring>

namespace rebound::test {
namespace {

constexpr VkMemoryPropertyFlags hostMemory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

std::unique_ptr<host::VulkanBuffer> stagingBuffer(const VulkanHost& host, size_t size) {
    auto buffer = host::VulkanBuffer::create(
        host.context(), size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        hostMemory);
    REQUIRE(buffer);
    return *std::move(buffer);
}

std::unique_ptr<host::VulkanImage> upload(const VulkanHost& host, const Picture& picture, Format format) {
    constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    auto image =
        host::VulkanImage::create(host.context(), picture.extent, vulkan::vulkanFormat(format), usage);
    REQUIRE(image);
    lab::Image source(picture.extent, picture.channels);
    source.data = picture.values;
    const auto texels = runner::texelsOf(source, format);
    const auto staging = stagingBuffer(host, texels.size());
    std::memcpy(staging->mapped, texels.data(), texels.size());
    REQUIRE(host.context().run([&](VkCommandBuffer commands) -> Result<> {
        host::recordTransition(commands, (*image)->image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
        host::recordUpload(commands, staging->buffer, 0, (*image)->image, picture.extent);
        host::recordFullBarrier(commands);
        return {};
    }));
    return *std::move(image);
}

} // namespace

std::unique_ptr<VulkanHost> VulkanHost::open() {
    interception() = {};
    host::VulkanOptions options;
    options.validation = true;
    auto context = host::VulkanContext::create(options);
    REQUIRE_MESSAGE(context, (context ? "" : context.error().message));
    return std::unique_ptr<VulkanHost>(new VulkanHost(*std::move(context)));
}

VulkanHost::~VulkanHost() {
    checkSilence();
    CHECK(interception().alive == 0);
}

void VulkanHost::checkSilence() const {
    for (const std::string& message : vulkan.messages()) FAIL_CHECK(message);
}

vulkan::DeviceOptions VulkanHost::options() const {
    vulkan::DeviceOptions o;
    o.getInstanceProcAddr = interceptedProcAddr;
    o.instance = vulkan.instance();
    o.physicalDevice = vulkan.physicalDevice();
    o.device = vulkan.device();
    o.queueFamily = vulkan.queueFamily();
    o.debugUtils = vulkan.hasDebugUtils();
    o.moreShaders = {testShaders()};
    return o;
}

vulkan::Device VulkanHost::device(const vulkan::DeviceOptions& options) const {
    auto device = vulkan::Device::create(options);
    REQUIRE_MESSAGE(device, (device ? "" : device.error().message));
    return *std::move(device);
}

GpuFrame::GpuFrame(const VulkanHost& h, const Plan& p, const NamedPictures& pictures,
                   std::vector<NamedConstants> constants)
    : host(h), plan(p), images(p.resources.size()) {
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& r = plan.resources[i];
        if (r.kind != ResourceKind::input && r.kind != ResourceKind::output) continue;
        Picture picture(r.extent, 4, -1.0f);
        for (const auto& named : pictures)
            if (named.first == r.name) picture = named.second;
        // Inputs in single precision: what kernels compute is compared, not what hosts store.
        images[i] = upload(host, picture, r.kind == ResourceKind::output ? r.format : Format::rgba32f);
        inputs.images.push_back(
            {r.name, {images[i]->view, r.extent, images[i]->format, VK_IMAGE_LAYOUT_GENERAL}});
    }
    inputs.constants = std::move(constants);
}

Picture GpuFrame::read(const std::string& output) const {
    const size_t index = size_t(plan.find(output));
    const Resource& r = plan.resources[index];
    const auto staging =
        stagingBuffer(host, bytesPerTexel(r.format) * size_t(r.extent.width) * size_t(r.extent.height));
    REQUIRE(host.context().run([&](VkCommandBuffer commands) -> Result<> {
        host::recordFullBarrier(commands);
        host::recordDownload(commands, images[index]->image, r.extent, staging->buffer, 0);
        host::recordFullBarrier(commands);
        return {};
    }));
    Picture picture(r.extent, r.channels);
    picture.values = runner::imageOf(staging->mapped, r.format, r.extent, r.channels).data;
    return picture;
}

Picture runOnVulkan(const VulkanHost& host, const vulkan::Device& device, const Plan& plan,
                    const NamedPictures& pictures, const std::vector<NamedConstants>& constants) {
    auto program = device.compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    const GpuFrame frame(host, plan, pictures, constants);
    const auto done = host.context().run(
        [&](VkCommandBuffer commands) { return program->record(commands, 0, frame.inputs); });
    REQUIRE_MESSAGE(done, (done ? "" : done.error().message));
    return frame.read("result");
}

Picture runOnCpu(const Plan& plan, const NamedPictures& pictures,
                 const std::vector<NamedConstants>& constants) {
    auto program = deviceFor(cpu::Isa::scalar).compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    NamedPictures kept = pictures;
    Picture result(plan.resources[size_t(plan.find("result"))].extent, 4, -1.0f);
    FrameInputs<cpu::Image> inputs;
    for (auto& [name, picture] : kept) inputs.images.push_back({name, picture.image()});
    inputs.images.push_back({"result", result.image()});
    inputs.constants = constants;
    const auto done = program->record(inputs);
    REQUIRE_MESSAGE(done, (done ? "" : done.error().message));
    return result;
}

Plan copyPlan(Extent2D extent, int mode) {
    const GridConstants k{{extent.width, extent.height, 0, 0}};
    Plan plan{"test", {}, {}};
    plan.add({"host", ResourceKind::input, Format::rgba32f, 4, extent, {}, 0});
    plan.add({"source", ResourceKind::transient, Format::rgba32f, 4, extent, {}, 0});
    plan.add({"result", ResourceKind::output, Format::rgba32f, 4, extent, {}, 0});
    plan.add({"grid", ResourceKind::frameConstants, {}, 1, {}, {}, sizeof(AccessConstants)});
    plan.add(bufferResource("constants", std::vector{k}));
    plan.passes.push_back({"copy", "copy", {}, {{0, 0}, {1, 1, Access::write}, {2, 4}}, extent});
    plan.passes.push_back(
        {"access", "access", {mode}, {{0, 1}, {1, 0}, {2, 2, Access::write}, {3, 3}}, extent});
    return plan;
}

NamedConstants accessConstants(Extent2D extent, ivec2 offset, int shift, int bias) {
    return {"grid",
            bytesOf(AccessConstants{{extent.width, extent.height, shift, bias}, {offset.x, offset.y, 0, 0}})};
}

Picture shifted(const Picture& picture, ivec2 offset) {
    Picture result(picture.extent, 4);
    for (int y = 0; y < picture.extent.height; ++y)
        for (int x = 0; x < picture.extent.width; ++x)
            for (int c = 0; c < 4; ++c) result.at(x, y, c) = picture.reach(x + offset.x, y + offset.y, c);
    return result;
}

bool runsRight(const VulkanHost& host, const vulkan::Device& device) {
    const Extent2D extent{20, 5};
    return runOnVulkan(host, device, copyPlan(extent), {{"host", numbered(extent)}},
                       {accessConstants(extent)})
               .values == shifted(numbered(extent), {2, 1}).values;
}

} // namespace rebound::test
