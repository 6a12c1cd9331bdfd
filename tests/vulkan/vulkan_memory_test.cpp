// SPDX-License-Identifier: MIT
// The Vulkan device's memory: how much, from whom, shared by whom, and that all of it goes back.
#include "vulkan_host.hpp"

#include "../unit/test_scene.hpp"

#include <set>

namespace rebound::test {
namespace {

constexpr Extent2D extent{20, 5};

// An engine's allocator. It hands out parts of its own blocks from an odd beginning on, so that an offset that is left
// out is seen.
class CountingAllocator {
public:
    explicit CountingAllocator(const VulkanHost& h) : host(h) {}

    vulkan::MemoryAllocator hooks() {
        return {[this](const vulkan::MemoryRequest& request) { return allocate(request); },
                [this](const vulkan::MemoryBlock& block) { free(block); }};
    }

    int requests = 0, refuseAt = -1; // the number of the request that finds no memory
    std::set<VkDeviceMemory> alive;
    size_t bytes = 0; // of all requests that were met
    bool unmapped = false, misaligned = false;

private:
    std::optional<vulkan::MemoryBlock> allocate(const vulkan::MemoryRequest& request) {
        if (requests++ == refuseAt) return std::nullopt;
        const VkMemoryRequirements& needs = request.requirements;
        const VkMemoryPropertyFlags flags =
            request.hostVisible ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
                                : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        vulkan::MemoryBlock block;
        block.memoryType = uint32_t(host.context().memoryType(needs.memoryTypeBits, flags));
        block.offset = 3 * needs.alignment;
        auto info = host::structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
        info.allocationSize = block.offset + needs.size;
        info.memoryTypeIndex = block.memoryType;
        REQUIRE(vkAllocateMemory(host.context().device(), &info, nullptr, &block.memory) == VK_SUCCESS);
        if (request.hostVisible && !unmapped)
            REQUIRE(vkMapMemory(host.context().device(), block.memory, block.offset, needs.size, 0,
                                &block.mapped) == VK_SUCCESS);
        if (misaligned) ++block.offset;
        block.tag = this;
        alive.insert(block.memory);
        bytes += size_t(needs.size);
        return block;
    }
    void free(const vulkan::MemoryBlock& block) {
        CHECK(block.tag == this);
        CHECK(alive.erase(block.memory) == 1);
        vkFreeMemory(host.context().device(), block.memory, nullptr);
    }
    const VulkanHost& host;
};

vulkan::Device deviceWith(const VulkanHost& host, CountingAllocator& allocator) {
    vulkan::DeviceOptions options = host.options();
    options.allocator = allocator.hooks();
    return host.device(options);
}

Plan screenPlan(Extent2D e) {
    const auto settings = screenIndirectPreset("half-64", e);
    REQUIRE(settings);
    auto plan = planScreenIndirect(*settings);
    REQUIRE(plan);
    return *plan;
}

} // namespace

TEST_CASE("memory use is told before compiling, and is what is asked of the engine's allocator") {
    const auto host = VulkanHost::open();
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{20, 5}, Extent2D{333, 111}}) {
        CountingAllocator allocator(*host);
        const vulkan::Device device = deviceWith(*host, allocator);
        for (const Plan& plan : {copyPlan(e), screenPlan(e)}) {
            allocator.bytes = 0;
            const auto use = device.memoryUse(plan);
            REQUIRE(use);
            CHECK(allocator.bytes == 0);
            auto program = device.compile(plan);
            REQUIRE(program);
            CHECK(program->memoryUse().transient == use->transient);
            CHECK(program->memoryUse().transientUnshared == use->transientUnshared);
            // The buffer's own padding is known once it exists: at most an alignment.
            CHECK(program->memoryUse().buffers >= use->buffers);
            CHECK(program->memoryUse().buffers < use->buffers + 256);
            CHECK(allocator.bytes == program->memoryUse().total());
            CHECK(use->transient >=
                  size_t(e.width) * size_t(e.height)); // a quarter of the pixels, 8 bytes each
            CHECK(use->transient <= use->transientUnshared);
        }
        CHECK(allocator.alive.empty());
    }
}

TEST_CASE(
    "an engine's allocator is used for everything, from the offsets it gives, and gets all of it back") {
    const auto host = VulkanHost::open();
    CountingAllocator allocator(*host);
    {
        const vulkan::Device device = deviceWith(*host, allocator);
        const int before = interception().alive;
        auto program = device.compile(copyPlan(extent));
        REQUIRE(program);
        CHECK(allocator.alive.size() == 2); // the transients' and the buffers'
        CHECK(runsRight(*host, device));
        program = device.compile(copyPlan({1, 1})); // assigning destroys the first
        CHECK(allocator.alive.size() == 2);
        CHECK(interception().alive > before);
    }
    CHECK(allocator.alive.empty());
    CHECK(interception().alive == 0);
}

TEST_CASE("out of memory: an error, nothing leaks, and the device works on") {
    const auto host = VulkanHost::open();
    CountingAllocator allocator(*host);
    const vulkan::Device device = deviceWith(*host, allocator);
    for (int refused : {0, 1}) {
        allocator.requests = 0;
        allocator.refuseAt = refused;
        const int before = interception().alive;
        const auto program = device.compile(screenPlan({64, 48}));
        REQUIRE_FALSE(program);
        CHECK(program.error().code == ErrorCode::outOfMemory);
        CHECK(program.error().message.find("bytes of device memory, which could not be allocated") !=
              std::string::npos);
        CHECK(allocator.alive.empty());
        CHECK(interception().alive == before);
    }
    allocator.refuseAt = -1;
    CHECK(runsRight(*host, device));
    CHECK(allocator.alive.empty());
}

TEST_CASE("blocks that do not suit are refused, and given back") {
    const auto host = VulkanHost::open();
    CountingAllocator allocator(*host);
    const vulkan::Device device = deviceWith(*host, allocator);
    for (bool CountingAllocator::*fault : {&CountingAllocator::unmapped, &CountingAllocator::misaligned}) {
        allocator.*fault = true;
        const auto program = device.compile(copyPlan(extent));
        REQUIRE_FALSE(program);
        CHECK(program.error().message.find("not mapped, or its offset is no multiple") != std::string::npos);
        CHECK(allocator.alive.empty());
        allocator.*fault = false;
    }
    CHECK(runsRight(*host, device));
}

TEST_CASE("whichever call fails while a plan is compiled, it is reported, and nothing leaks") {
    const auto host = VulkanHost::open();
    vulkan::DeviceOptions options = host->options();
    options.timings = true;
    const Plan plan = screenPlan({64, 48});
    int failures = 0;
    for (bool made = false; !made; failures += made ? 0 : 1) {
        {
            const vulkan::Device device = host->device(options);
            interception().calls = 0;
            interception().failAt = failures;
            const auto program = device.compile(plan);
            made = bool(program);
            CAPTURE(failures);
            if (!program) CHECK(program.error().code == ErrorCode::outOfMemory);
            interception().failAt = -1;
            if (failures % 8 == 0)
                CHECK(device.compile(plan)); // what it kept of the failed attempt is of use
        }
        CHECK(interception().alive == 0);
    }
    CHECK(failures > 30); // images, views, kernels, pipelines, sets, queries
    host->checkSilence();
}

TEST_CASE("views of different sizes share transients, the largest first") {
    const auto host = VulkanHost::open();
    CountingAllocator allocator(*host);
    const vulkan::Device device = deviceWith(*host, allocator);
    const Extent2D largeExtent{70, 40}, smallExtent{33, 21};
    const Plan largePlan = copyPlan(largeExtent), smallPlan = copyPlan(smallExtent);
    auto large = device.compile(largePlan);
    REQUIRE(large);
    const auto use = device.memoryUse(smallPlan, {2, &*large, false});
    REQUIRE(use);
    CHECK(use->transient == 0);
    auto small = device.compile(smallPlan, {2, &*large, false});
    REQUIRE(small);
    CHECK(small->memoryUse().transient == 0);
    CHECK(allocator.alive.size() == 3); // one of transients, two of buffers
    const GpuFrame largeFrame(*host, largePlan, {{"host", numbered(largeExtent)}},
                              {accessConstants(largeExtent)});
    const GpuFrame smallFrame(*host, smallPlan, {{"host", numbered(smallExtent)}},
                              {accessConstants(smallExtent)});
    // Twice behind each other in one command buffer: each has to wait for the other.
    REQUIRE(host->context().run([&](VkCommandBuffer commands) -> Result<> {
        for (int frame : {0, 1}) {
            REQUIRE(large->record(commands, frame, largeFrame.inputs));
            REQUIRE(small->record(commands, frame, smallFrame.inputs));
        }
        return {};
    }));
    CHECK(largeFrame.read("result").values == shifted(numbered(largeExtent), {2, 1}).values);
    CHECK(smallFrame.read("result").values == shifted(numbered(smallExtent), {2, 1}).values);

    large = device.compile(copyPlan({1, 1})); // the owner goes; the memory stays as long as it is shared
    REQUIRE(host->context().run(
        [&](VkCommandBuffer commands) { return small->record(commands, 0, smallFrame.inputs); }));
    CHECK(smallFrame.read("result").values == shifted(numbered(smallExtent), {2, 1}).values);
}

TEST_CASE("transients that are too small, or that do not suit, are not shared") {
    const auto host = VulkanHost::open();
    CountingAllocator allocator(*host);
    const vulkan::Device device = deviceWith(*host, allocator);
    auto small = device.compile(copyPlan(extent));
    REQUIRE(small);
    const auto refuse = [&](Extent2D e, const std::string& part) {
        const auto refused = device.compile(copyPlan(e), {2, &*small, false});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::invalidArgument);
        INFO(refused.error().message);
        CHECK(refused.error().message.find(part) != std::string::npos);
        CHECK(allocator.alive.size() == 2);
    };
    refuse({70, 40}, "shareTransientsWith has ");
    // Small enough, but that program's memory begins at no multiple of such an alignment: at 3 times the true one.
    interception().changeImageNeeds = [](VkMemoryRequirements& needs) { needs.alignment *= 2; };
    refuse({1, 1}, "an alignment that suit");
    interception().changeImageNeeds = {};

    Plan direct{"direct", {}, {}}; // has no transients to share
    direct.add({"host", ResourceKind::input, Format::rgba32f, 4, extent, {}, 0});
    direct.add({"start", ResourceKind::input, Format::rgba32f, 4, extent, {}, 0});
    direct.add({"result", ResourceKind::output, Format::rgba32f, 4, extent, {}, 0});
    direct.add(bufferResource("k", std::vector{LanguageConstants{{extent.width, extent.height, 0, 0}, {}}}));
    direct.add(bufferResource("entries", std::vector<TableEntry>(1)));
    direct.passes.push_back(
        {"language", "language", {}, {{0, 0}, {1, 2, Access::write}, {2, 3}, {3, 4}}, extent});
    auto none = device.compile(direct);
    REQUIRE_MESSAGE(none, (none ? "" : none.error().message));
    CHECK_FALSE(device.compile(copyPlan(extent), {2, &*none, false}));
    CHECK(device.compile(direct, {2, &*none, false})); // neither has any
}

TEST_CASE("recompiling at other sizes frees what was, and keeps the pipelines") {
    const auto host = VulkanHost::open();
    CountingAllocator allocator(*host);
    const vulkan::Device device = deviceWith(*host, allocator);
    Frame scene = sceneFrame({}, {16, 16});
    REQUIRE(device.compile(*planScreenIndirect(scene.settings)));
    const int kept = interception().alive;
    for (Extent2D e :
         {Extent2D{96, 54}, Extent2D{1, 1}, Extent2D{7, 300}, Extent2D{131, 77}, Extent2D{96, 54}}) {
        {
            scene = sceneFrame({}, e);
            auto plan = planScreenIndirect(scene.settings);
            REQUIRE(plan);
            auto program = device.compile(*plan);
            REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
            const auto constants = cameraConstants(scene.camera, scene.settings.conventions, e);
            REQUIRE(constants);
            const GpuFrame frame(*host, *plan,
                                 {{"depth", scene.depth},
                                  {"normal", scene.normal},
                                  {"radiance", scene.radiance},
                                  {"albedo", scene.albedo},
                                  {"lit", scene.lit}},
                                 {{"camera", bytesOf(*constants)}});
            REQUIRE(host->context().run(
                [&](VkCommandBuffer commands) { return program->record(commands, 0, frame.inputs); }));
            const Picture composed = frame.read("composed");
            const Picture expected = render(scene, deviceFor(cpu::Isa::scalar)).composed;
            // Outputs in half precision, and a few texels chosen otherwise where two are equally good.
            if (e.width > 1) CHECK(difference(expected, composed).average < 2e-3);
            CHECK(allFinite(composed));
        }
        CHECK(allocator.alive.empty());
        // Pipelines for new features may join, in tens; objects of a program would add hundreds over the sizes.
        CHECK(interception().alive <= kept + 8);
    }
    host->checkSilence();
}

} // namespace rebound::test
