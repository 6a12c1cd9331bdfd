// SPDX-License-Identifier: MIT
// The Vulkan device: what it refuses, and that what it refuses leaves no trace.
#include "vulkan_host.hpp"

#include <functional>
#include <optional>

namespace rebound::test {
namespace {

constexpr Extent2D extent{20, 5};

template <class T>
void checkRefused(const Result<T>& result, ErrorCode code, const std::string& part) {
    CAPTURE(part);
    REQUIRE_FALSE(result);
    INFO(result.error().message);
    CHECK(result.error().code == code);
    CHECK(result.error().message.find(part) != std::string::npos);
}

// host -> copy -> source -> access -> result, spoilt.
void checkRefusedPlan(const vulkan::Device& device, ErrorCode code, const std::string& part,
                      const std::function<void(Plan&)>& spoil) {
    Plan plan = copyPlan(extent);
    spoil(plan);
    const int before = interception().alive;
    checkRefused(device.compile(plan), code, part);
    checkRefused(device.memoryUse(plan), code, part);
    CHECK(interception().alive == before);
}

} // namespace

TEST_CASE("a device is refused where a handle is null or the allocator is half a one") {
    const auto host = VulkanHost::open();
    using Options = vulkan::DeviceOptions;
    const auto refuse = [&](const std::string& part, const std::function<void(Options&)>& spoil) {
        Options options = host->options();
        spoil(options);
        checkRefused(vulkan::Device::create(options), ErrorCode::invalidArgument, part);
        CHECK(interception().alive == 0);
    };
    refuse("getInstanceProcAddr is null", [](Options& o) { o.getInstanceProcAddr = nullptr; });
    refuse("instance is null", [](Options& o) { o.instance = VK_NULL_HANDLE; });
    refuse("physicalDevice is null", [](Options& o) { o.physicalDevice = VK_NULL_HANDLE; });
    refuse("device is null", [](Options& o) { o.device = VK_NULL_HANDLE; });
    refuse("both or neither", [](Options& o) { o.allocator.free = [](const vulkan::MemoryBlock&) {}; });
    refuse("both or neither", [](Options& o) {
        o.allocator.allocate = [](const vulkan::MemoryRequest&) { return std::nullopt; };
    });
    refuse("queueFamily is 4000000000", [](Options& o) { o.queueFamily = 4000000000u; });
}

TEST_CASE("a device is refused where what it wraps cannot do what Rebound needs") {
    const auto host = VulkanHost::open();
    interception().changeQueueFamily = [](VkQueueFamilyProperties& family) {
        family.queueFlags &= ~VkQueueFlags(VK_QUEUE_COMPUTE_BIT);
    };
    checkRefused(vulkan::Device::create(host->options()), ErrorCode::unsupported, "does not compute");
    interception() = {};
    interception().changeProperties = [](VkPhysicalDeviceProperties& p) {
        p.apiVersion = VK_MAKE_API_VERSION(0, 1, 0, 9);
    };
    checkRefused(vulkan::Device::create(host->options()), ErrorCode::unsupported, "Vulkan 1.0; 1.1 or later");
    for (const char* name :
         {"vkGetDeviceProcAddr", "vkCmdDispatch", "vkCreateImage", "vkSetDebugUtilsObjectNameEXT"}) {
        interception() = {};
        interception().missing = name;
        checkRefused(vulkan::Device::create(host->options()), ErrorCode::unsupported,
                     std::string("knows no ") + name);
        CHECK(interception().alive == 0);
    }
    // Functions of an extension that the host does not mention are not asked for.
    vulkan::DeviceOptions plain = host->options();
    plain.debugUtils = false;
    CHECK(vulkan::Device::create(plain));
}

TEST_CASE("each call that fails while a device is made is reported, and leaves nothing") {
    const auto host = VulkanHost::open();
    int failures = 0;
    for (bool made = false; !made; failures += made ? 0 : 1) {
        interception().calls = 0;
        interception().failAt = failures;
        const auto device = vulkan::Device::create(host->options());
        made = bool(device);
        if (!device) checkRefused(device, ErrorCode::outOfMemory, "VK_ERROR_OUT_OF_DEVICE_MEMORY");
        if (!device) CHECK(interception().alive == 0);
    }
    CHECK(failures == 2); // the sampler and the pipeline cache
}

TEST_CASE("plans that a device refuses") {
    const auto host = VulkanHost::open();
    using enum ErrorCode;
    const vulkan::Device device = host->device();
    checkRefusedPlan(device, notFound, "runs no/such", [](Plan& p) { p.passes[0].kernel = "no/such"; });
    checkRefusedPlan(device, notFound, "", [](Plan& p) { p.passes[0].kernel = ""; });
    checkRefusedPlan(device, invalidArgument, "slot 9", [](Plan& p) { p.passes[0].bindings[0].slot = 9; });
    checkRefusedPlan(device, invalidArgument, "leaves slot 1 of access unbound",
                     [](Plan& p) { p.passes[1].bindings.erase(p.passes[1].bindings.begin() + 1); });
    checkRefusedPlan(device, invalidArgument, "feature 0 of access to " + std::to_string(accessCount),
                     [](Plan& p) { p.passes[1].features = {accessCount}; });
    checkRefusedPlan(device, invalidArgument, "which does not take it",
                     [](Plan& p) { p.passes[1].bindings[0].resource = 0; });
    checkRefusedPlan(device, invalidArgument, "which is rgba16f, through slot 1 of copy, which is rgba32f",
                     [](Plan& p) { p.resources[1].format = Format::rgba16f; });
    checkRefusedPlan(device, invalidArgument, "which is r32f, through slot 2 of access",
                     [](Plan& p) { p.resources[2].format = Format::r32f; });
    checkRefusedPlan(device, invalidArgument, "size is not that of the pass's grid", [](Plan& p) {
        p.passes[0].grid = {19, 5};
    });
    checkRefusedPlan(device, invalidArgument, "used twice", [](Plan& p) { p.passes[1].label = "copy"; });
    for (int frames : {0, -1, 9})
        checkRefused(device.compile(copyPlan(extent), {frames, nullptr, false}), invalidArgument,
                     "framesInFlight is " + std::to_string(frames) + "; 1 to 8 was expected");
    CHECK(device.compile(copyPlan(extent)));
}

TEST_CASE("plans beyond the device's limits are refused") {
    const auto host = VulkanHost::open();
    interception().changeProperties = [](VkPhysicalDeviceProperties& p) {
        p.limits.maxImageDimension2D = 19;
        p.limits.maxUniformBufferRange = 31;
    };
    const vulkan::Device device = host->device();
    checkRefused(device.compile(copyPlan({20, 5})), ErrorCode::unsupported,
                 "host is 20x5; this device's images have at most 19");
    checkRefused(device.compile(copyPlan({19, 5})), ErrorCode::unsupported, "grid has 32 bytes");
}

TEST_CASE("frames that a program refuses, recording nothing") {
    const auto host = VulkanHost::open();
    const Plan plan = copyPlan(extent);
    const vulkan::Device device = host->device();
    auto program = device.compile(plan);
    REQUIRE(program);
    const GpuFrame good(*host, plan, {{"host", numbered(extent)}}, {accessConstants(extent)});
    using Inputs = FrameInputs<vulkan::Image>;
    const auto refuse = [&](const std::string& part, const std::function<void(Inputs&)>& spoil,
                            int frame = 0) {
        Inputs inputs = good.inputs;
        spoil(inputs);
        REQUIRE(host->context().run([&](VkCommandBuffer commands) -> Result<> {
            checkRefused(program->record(commands, frame, inputs), ErrorCode::invalidArgument, part);
            return {};
        }));
    };
    refuse("host is missing", [](Inputs& i) { i.images.erase(i.images.begin()); });
    refuse("result is missing", [](Inputs& i) { i.images.pop_back(); });
    refuse("grid is missing", [](Inputs& i) { i.constants.clear(); });
    refuse("31 bytes; 32 were expected", [](Inputs& i) { i.constants[0].data.pop_back(); });
    refuse("named source", [](Inputs& i) { i.images.push_back({"source", i.images[0].image}); });
    refuse("host is given twice", [](Inputs& i) { i.images.push_back(i.images[0]); });
    refuse("host has no view", [](Inputs& i) { i.images[0].image.view = VK_NULL_HANDLE; });
    refuse("result has no view", [](Inputs& i) { i.images[1].image.view = VK_NULL_HANDLE; });
    refuse("host is 20x4; 20x5 was expected", [](Inputs& i) { i.images[0].image.extent.height = 4; });
    refuse("result and host have one view; an output of its own was expected",
           [](Inputs& i) { i.images[1].image.view = i.images[0].image.view; });
    refuse("result is 21x5; 20x5 was expected", [](Inputs& i) { i.images[1].image.extent.width = 21; });
    refuse("rgba32f, was expected",
           [](Inputs& i) { i.images[1].image.format = VK_FORMAT_R16G16B16A16_SFLOAT; });
    for (VkImageLayout layout : {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_UNDEFINED})
        refuse("VK_IMAGE_LAYOUT_GENERAL was expected", [=](Inputs& i) { i.images[1].image.layout = layout; });
    for (VkImageLayout layout :
         {VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_PREINITIALIZED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
          VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL})
        refuse("in which shaders read was expected", [=](Inputs& i) { i.images[0].image.layout = layout; });
    for (int frame : {-1, 2})
        refuse(
            "frame is " + std::to_string(frame) + "; 0 to 1 was expected", [](Inputs&) {}, frame);
    checkRefused(program->record(VK_NULL_HANDLE, 0, good.inputs), ErrorCode::invalidArgument,
                 "commands is null");
    CHECK(good.read("result").values == Picture(extent, 4, -1.0f).values);

    // Having refused all of these, it runs.
    REQUIRE(host->context().run(
        [&](VkCommandBuffer commands) { return program->record(commands, 0, good.inputs); }));
    CHECK(good.read("result").values == shifted(numbered(extent), {2, 1}).values);
}

TEST_CASE("a program outlives its device and the host's copy of the plan") {
    const auto host = VulkanHost::open();
    std::optional<vulkan::Program> program;
    {
        auto compiled = host->device().compile(copyPlan(extent));
        REQUIRE(compiled);
        program = *std::move(compiled);
    }
    const GpuFrame frame(*host, program->plan(), {{"host", numbered(extent)}},
                         {accessConstants(extent, {-1, 0})});
    REQUIRE(host->context().run(
        [&](VkCommandBuffer commands) { return program->record(commands, 1, frame.inputs); }));
    CHECK(frame.read("result").values == shifted(numbered(extent), {-1, 0}).values);
}

TEST_CASE("transients are there to be copied where that was asked for") {
    const auto host = VulkanHost::open();
    const vulkan::Device device = host->device();
    auto plain = device.compile(copyPlan(extent));
    auto inspectable = device.compile(copyPlan(extent), {2, nullptr, true});
    REQUIRE(plain);
    REQUIRE(inspectable);
    checkRefused(plain->ownImage("source"), ErrorCode::invalidArgument, "inspectable");
    for (const char* name : {"host", "result", "constants", "nothing", ""})
        checkRefused(inspectable->ownImage(name), ErrorCode::notFound, "in use named");
    CHECK(inspectable->ownImage("source"));
    std::vector<int> passes;
    inspectable->onPass([&](VkCommandBuffer commands, int pass) {
        passes.push_back(pass);
        host::recordFullBarrier(commands);
    });
    const GpuFrame frame(*host, inspectable->plan(), {{"host", numbered(extent)}}, {accessConstants(extent)});
    const auto run = [&] {
        REQUIRE(host->context().run(
            [&](VkCommandBuffer commands) { return inspectable->record(commands, 0, frame.inputs); }));
    };
    run();
    CHECK(passes == std::vector<int>{0, 1});
    inspectable->onPass({});
    run();
    CHECK(passes.size() == 2);
}

TEST_CASE("a pipeline cache is taken back from an earlier run, and only if it is whole and this driver's") {
    const auto host = VulkanHost::open();
    const vulkan::Device first = host->device();
    CHECK(interception().cacheSize == 0);
    REQUIRE(first.compile(copyPlan(extent)));
    const auto kept = first.pipelineCache();
    REQUIRE(kept);
    REQUIRE_FALSE(kept->empty());
    // How much of a stored cache reaches the driver; whatever it is, the device works.
    const auto accepted = [&](const std::vector<std::byte>& stored) {
        vulkan::DeviceOptions options = host->options();
        options.pipelineCache = stored;
        const vulkan::Device device = host->device(options);
        const size_t size = interception().cacheSize;
        CHECK(runsRight(*host, device));
        return size;
    };
    CHECK(accepted(*kept) > 0);
    CHECK(accepted({}) == 0);
    for (size_t i = 0; i < kept->size(); ++i) {
        std::vector<std::byte> spoilt = *kept;
        spoilt[i] ^= std::byte(0x10);
        if (i % 7 == 0 || i + 1 == kept->size()) CHECK(accepted(spoilt) == 0);
    }
    std::vector<std::byte> cut = *kept, longer = *kept;
    cut.pop_back();
    longer.push_back(std::byte(0));
    CHECK(accepted(cut) == 0);
    CHECK(accepted(longer) == 0);
    CHECK(accepted(std::vector<std::byte>(10000, std::byte(0xa5))) == 0);
    CHECK(accepted({std::byte(1)}) == 0);
}

} // namespace rebound::test
