// SPDX-License-Identifier: MIT
// Frames of a Vulkan program: several in flight, and how long they took.
#include "vulkan_host.hpp"

namespace rebound::test {
namespace {

constexpr Extent2D extent{40, 24};

// Command buffers that are recorded one after another and submitted together.
class Recordings {
public:
    Recordings(const VulkanHost& h, uint32_t count) : host(h), commands(count) {
        auto info = host::structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
        info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        info.queueFamilyIndex = host.context().queueFamily();
        REQUIRE(vkCreateCommandPool(host.context().device(), &info, nullptr, &pool) == VK_SUCCESS);
        auto allocation =
            host::structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
        allocation.commandPool = pool;
        allocation.commandBufferCount = count;
        REQUIRE(vkAllocateCommandBuffers(host.context().device(), &allocation, commands.data()) ==
                VK_SUCCESS);
    }
    Recordings(const Recordings&) = delete;
    Recordings& operator=(const Recordings&) = delete;
    ~Recordings() { vkDestroyCommandPool(host.context().device(), pool, nullptr); }

    void record(size_t index, vulkan::Program& program, int frame, const FrameInputs<vulkan::Image>& inputs) {
        const auto begin =
            host::structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
        REQUIRE(vkBeginCommandBuffer(commands[index], &begin) == VK_SUCCESS);
        REQUIRE(program.record(commands[index], frame, inputs));
        REQUIRE(vkEndCommandBuffer(commands[index]) == VK_SUCCESS);
    }
    void submitAll() {
        auto submit = host::structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
        submit.commandBufferCount = uint32_t(commands.size());
        submit.pCommandBuffers = commands.data();
        REQUIRE(vkQueueSubmit(host.context().queue(), 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS);
        REQUIRE(vkQueueWaitIdle(host.context().queue()) == VK_SUCCESS);
    }

private:
    const VulkanHost& host;
    VkCommandPool pool = VK_NULL_HANDLE;
    std::vector<VkCommandBuffer> commands;
};

} // namespace

TEST_CASE("frames in flight keep their own constants and images") {
    const auto host = VulkanHost::open();
    for (int count : {1, 2, 3, 8}) {
        const Plan plan = copyPlan(extent);
        auto program = host->device().compile(plan, {count, nullptr, false});
        REQUIRE(program);
        std::vector<std::unique_ptr<GpuFrame>> frames;
        for (int i = 0; i < count; ++i) {
            Picture picture = numbered(extent);
            for (float& value : picture.values) value += 1000.0f * float(i);
            frames.push_back(std::make_unique<GpuFrame>(*host, plan, NamedPictures{{"host", picture}},
                                                        std::vector{accessConstants(extent, {i, -i})}));
        }
        Recordings recordings(*host, uint32_t(count));
        // All are recorded before the first one runs, and twice over.
        for (int round = 0; round < 2; ++round) {
            for (int i = 0; i < count; ++i)
                recordings.record(size_t(i), *program, i, frames[size_t(i)]->inputs);
            recordings.submitAll();
            if (round == 0) vkDeviceWaitIdle(host->context().device());
        }
        for (int i = 0; i < count; ++i) {
            Picture picture = numbered(extent);
            for (float& value : picture.values) value += 1000.0f * float(i);
            CHECK(frames[size_t(i)]->read("result").values == shifted(picture, {i, -i}).values);
        }
    }
}

TEST_CASE("inputs are read in any layout in which shaders read") {
    const auto host = VulkanHost::open();
    const Plan plan = copyPlan(extent);
    auto program = host->device().compile(plan);
    REQUIRE(program);
    auto image = host::VulkanImage::create(host->context(), extent, VK_FORMAT_R32G32B32A32_SFLOAT,
                                           VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    REQUIRE(image);
    GpuFrame frame(*host, plan, {}, {accessConstants(extent, {0, 0})});
    frame.inputs.images[0].image = {(*image)->view, extent, VK_FORMAT_UNDEFINED,
                                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkClearColorValue colour{{1.5f, -2.0f, 0.25f, 7.0f}};
    REQUIRE(host->context().run([&](VkCommandBuffer commands) -> Result<> {
        host::recordTransition(commands, (*image)->image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
        const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdClearColorImage(commands, (*image)->image, VK_IMAGE_LAYOUT_GENERAL, &colour, 1, &all);
        host::recordTransition(commands, (*image)->image, VK_IMAGE_LAYOUT_GENERAL,
                               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        return program->record(commands, 0, frame.inputs);
    }));
    const Picture result = frame.read("result");
    for (size_t i = 0; i < result.values.size(); ++i) CHECK(result.values[i] == colour.float32[i % 4]);
}

TEST_CASE("timings: a pass each where they were asked for and the GPU is done, and none otherwise") {
    const auto host = VulkanHost::open();
    for (bool wanted : {false, true}) {
        vulkan::DeviceOptions options = host->options();
        options.timings = wanted;
        const Plan plan = copyPlan({512, 256});
        auto program = host->device(options).compile(plan);
        REQUIRE(program);
        const auto measured = [&] {
            auto timings = program->timings();
            REQUIRE(timings);
            return *timings;
        };
        CHECK(measured().empty());
        const GpuFrame frame(*host, plan, {{"host", numbered({512, 256})}}, {accessConstants({512, 256})});
        Recordings recordings(*host, 1);
        for (int run = 0; run < 2; ++run) {
            recordings.record(0, *program, 1, frame.inputs);
            recordings.submitAll();
            REQUIRE(measured().size() == (wanted ? 2u : 0u));
        }
        CHECK(frame.read("result").values == shifted(numbered({512, 256}), {2, 1}).values);
        if (!wanted) continue;
        CHECK(measured()[0].label == "copy");
        CHECK(measured()[1].label == "access");
        double sum = 0.0;
        for (const PassTiming& t : measured()) {
            CHECK(t.milliseconds >= 0.0);
            sum += t.milliseconds;
        }
        CHECK(sum > 0.0);
        CHECK(sum < 60000.0); // a wrong unit or a wrapped counter would be years
    }
}

TEST_CASE("timings are none where the queue family has no timestamps") {
    const auto host = VulkanHost::open();
    interception().changeQueueFamily = [](VkQueueFamilyProperties& family) { family.timestampValidBits = 0; };
    vulkan::DeviceOptions options = host->options();
    options.timings = true;
    const Plan plan = copyPlan(extent);
    auto program = host->device(options).compile(plan);
    REQUIRE(program);
    const GpuFrame frame(*host, plan, {{"host", numbered(extent)}}, {accessConstants(extent)});
    REQUIRE(host->context().run(
        [&](VkCommandBuffer commands) { return program->record(commands, 0, frame.inputs); }));
    const auto timings = program->timings();
    REQUIRE(timings);
    CHECK(timings->empty());
}

} // namespace rebound::test
