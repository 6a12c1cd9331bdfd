// SPDX-License-Identifier: MIT
// A GPU that stops answering: whichever call finds out says so, all later ones do too, and everything can be destroyed.
#include "vulkan_host.hpp"

#include <map>

namespace rebound::test {
namespace {

constexpr Extent2D extent{20, 5};

// What each function is called for, in the words of an error.
const std::map<std::string, std::string> purposes = {
    {"vkAllocateDescriptorSets", "allocating descriptor sets"},
    {"vkAllocateMemory", "allocating "},
    {"vkBindBufferMemory", "binding memory to a buffer"},
    {"vkBindImageMemory", "binding memory to source"},
    {"vkCreateBuffer", "creating a buffer"},
    {"vkCreateComputePipelines", "creating a pipeline of "},
    {"vkCreateDescriptorPool", "creating a descriptor pool"},
    {"vkCreateDescriptorSetLayout", "creating the descriptor set layout of "},
    {"vkCreateImage", "creating source"},
    {"vkCreateImageView", "creating a view of source"},
    {"vkCreatePipelineCache", "creating a pipeline cache"},
    {"vkCreatePipelineLayout", "creating the pipeline layout of "},
    {"vkCreateQueryPool", "creating a query pool"},
    {"vkCreateSampler", "creating a sampler"},
    {"vkCreateShaderModule", "creating the shader module of "},
    {"vkGetPipelineCacheData", "reading the pipeline cache"},
    {"vkGetQueryPoolResults", "reading timestamps"},
    {"vkMapMemory", "mapping "},
};

vulkan::DeviceOptions timedOptions(const VulkanHost& host) {
    vulkan::DeviceOptions options = host.options();
    options.timings = true;
    return options;
}

// From now on, call number `call` fails with that result.
void failAt(int call, VkResult result) {
    interception().calls = 0;
    interception().failAt = call;
    interception().failure = result;
}

template <class T>
void checkLost(const Result<T>& result) {
    CAPTURE(interception().failed);
    REQUIRE_FALSE(result);
    INFO(result.error().message);
    CHECK(result.error().code == ErrorCode::deviceLost);
    CHECK(result.error().message.starts_with(purposes.at(interception().failed)));
    CHECK(result.error().message.find("VK_ERROR_DEVICE_LOST: the device is lost") != std::string::npos);
}

// Every call says the same, and none reaches Vulkan.
void checkStaysLost(const vulkan::Device& device) {
    failAt(-1, VK_SUCCESS);
    checkLost(device.compile(copyPlan(extent)));
    checkLost(device.compile(Plan{"invalid", {}, {{"pass", "no/such", {}, {}, {}}}}));
    checkLost(device.memoryUse(copyPlan(extent)));
    checkLost(device.pipelineCache());
    CHECK(interception().calls == 0);
}

// A program of its own, and a frame for it.
struct TimedProgram {
    const VulkanHost& host;
    vulkan::Program program;
    GpuFrame frame;

    TimedProgram(const VulkanHost& h, const vulkan::Device& device)
        : host(h), program(compiled(device)),
          frame(h, program.plan(), {{"host", numbered(extent)}}, {accessConstants(extent)}) {}

    static vulkan::Program compiled(const vulkan::Device& device) {
        auto program = device.compile(copyPlan(extent));
        REQUIRE(program);
        return *std::move(program);
    }
    Result<> record() {
        return host.context().run(
            [&](VkCommandBuffer commands) { return program.record(commands, 0, frame.inputs); });
    }
    // Nothing is recorded, even where the host goes on and submits.
    void checkStaysLost() {
        failAt(-1, VK_SUCCESS);
        REQUIRE(host.context().run([&](VkCommandBuffer commands) -> Result<> {
            checkLost(program.record(commands, 0, frame.inputs));
            checkLost(program.record(VK_NULL_HANDLE, -1, {}));
            return {};
        }));
        checkLost(program.timings());
        CHECK(interception().calls == 0);
    }
};

} // namespace

TEST_CASE("lost while a device is made: an error that says so, and nothing is left") {
    const auto host = VulkanHost::open();
    for (int call : {0, 1}) {
        failAt(call, VK_ERROR_DEVICE_LOST);
        checkLost(vulkan::Device::create(host->options()));
        CHECK(interception().alive == 0);
    }
    failAt(-1, VK_SUCCESS);
    CHECK(runsRight(*host, host->device())); // another device of Rebound's does not know of it
}

TEST_CASE("lost while a plan is compiled, at any call: it and all later calls say so, and nothing leaks") {
    const auto host = VulkanHost::open();
    std::map<std::string, int> found;
    for (bool made = false; !made;) {
        {
            const vulkan::Device device = host->device(timedOptions(*host));
            int failures = 0;
            for (const auto& counted : found) failures += counted.second;
            failAt(failures, VK_ERROR_DEVICE_LOST);
            const auto program = device.compile(copyPlan(extent));
            made = bool(program);
            if (!made) {
                checkLost(program);
                ++found[interception().failed];
                checkStaysLost(device);
            }
            failAt(-1, VK_SUCCESS);
        }
        CHECK(interception().alive == 0);
    }
    // All but those of create(), timings() and pipelineCache(): else they were not tried.
    CHECK(found.size() == purposes.size() - 4);
}

TEST_CASE("lost while a plan is measured, or the pipeline cache read") {
    const auto host = VulkanHost::open();
    const vulkan::Device measured = host->device();
    failAt(0, VK_ERROR_DEVICE_LOST);
    checkLost(measured.memoryUse(copyPlan(extent)));
    checkStaysLost(measured);
    for (int call : {0, 1}) { // its size, and its bytes
        const vulkan::Device device = host->device();
        failAt(call, VK_ERROR_DEVICE_LOST);
        checkLost(device.pipelineCache());
        CHECK(interception().calls == call + 1);
        checkStaysLost(device);
    }
}

TEST_CASE("a program that finds the device lost by its timings, and one of the same device") {
    const auto host = VulkanHost::open();
    {
        const vulkan::Device device = host->device(timedOptions(*host));
        TimedProgram finder(*host, device), other(*host, device);
        REQUIRE(finder.record());
        failAt(0, VK_ERROR_DEVICE_LOST);
        checkLost(finder.program.timings());
        finder.checkStaysLost();
        other.checkStaysLost();
        checkStaysLost(device);
        CHECK(other.frame.read("result").values == Picture(extent, 4, -1.0f).values);
        CHECK(finder.program.memoryUse().total() > 0); // asks nothing of the device
    }
    CHECK(interception().alive == 0);
    host->checkSilence();
}

TEST_CASE("a program is refused frames once a plan's compilation has found the device lost") {
    const auto host = VulkanHost::open();
    const vulkan::Device device = host->device(timedOptions(*host));
    TimedProgram earlier(*host, device);
    REQUIRE(earlier.record());
    failAt(0, VK_ERROR_DEVICE_LOST);
    checkLost(device.compile(copyPlan({33, 21})));
    earlier.checkStaysLost();
    CHECK(earlier.frame.read("result").values ==
          shifted(numbered(extent), {2, 1}).values); // of the frame before
}

TEST_CASE("any other error leaves the device usable") {
    const auto host = VulkanHost::open();
    const std::pair<VkResult, ErrorCode> errors[] = {{VK_ERROR_OUT_OF_HOST_MEMORY, ErrorCode::outOfMemory},
                                                     {VK_ERROR_OUT_OF_DEVICE_MEMORY, ErrorCode::outOfMemory},
                                                     {VK_ERROR_MEMORY_MAP_FAILED, ErrorCode::outOfMemory},
                                                     {VK_ERROR_INITIALIZATION_FAILED, ErrorCode::unsupported},
                                                     {VK_ERROR_UNKNOWN, ErrorCode::unsupported}};
    for (const auto& error : errors) {
        const VkResult result = error.first;
        CAPTURE(int(result));
        const vulkan::Device device = host->device(timedOptions(*host));
        const auto check = [&](const auto& failed) {
            failAt(-1, VK_SUCCESS);
            REQUIRE_FALSE(failed);
            CHECK(failed.error().code == error.second);
            CHECK(runsRight(*host, device));
        };
        // With kernels and pipelines from the first run that is right on, fewer calls are left to fail.
        for (int call = 0; call < 8; ++call) {
            failAt(call, result);
            check(device.compile(copyPlan(extent)));
        }
        failAt(0, result);
        check(device.memoryUse(copyPlan(extent)));
        failAt(1, result);
        check(device.pipelineCache());
        TimedProgram timed(*host, device);
        REQUIRE(timed.record());
        failAt(0, result);
        check(timed.program.timings());
        CHECK(timed.program.timings()->size() == 2);
        REQUIRE(timed.record());
        CHECK(timed.frame.read("result").values == shifted(numbered(extent), {2, 1}).values);
    }
}

} // namespace rebound::test
