// SPDX-License-Identifier: MIT
// The CPU device: how it runs what it accepts. What it refuses: cpu_refusals_test.cpp.
#include "copy_plan.hpp"

#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <thread>

namespace rebound::test {

TEST_CASE("instruction sets have names, and scalar is always there") {
    using cpu::Isa;
    for (Isa isa : {Isa::automatic, Isa::scalar, Isa::baseline, Isa::avx2, Isa::avx512}) {
        const auto found = cpu::isaFromName(cpu::name(isa));
        REQUIRE(found);
        CHECK(*found == isa);
    }
    for (const char* unknown : {"", "AVX2", "sse", "scalar "}) {
        const auto found = cpu::isaFromName(unknown);
        REQUIRE_FALSE(found);
        CHECK(found.error().message.find("avx512") != std::string::npos);
    }
    const auto available = cpu::availableIsas();
    REQUIRE_FALSE(available.empty());
    CHECK(available.front() == Isa::scalar);
    for (Isa isa : available) CHECK(cpu::isAvailable(isa));
    CHECK(cpu::isAvailable(Isa::automatic));
    CHECK(deviceFor(Isa::automatic).isa() == available.back());
    CHECK_FALSE(cpu::isAvailable(Isa(99)));
}

TEST_CASE("a CPU device is refused for what the machine or the build lacks") {
    for (int threads : {-1, 1025, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
        cpu::DeviceOptions options;
        options.threads = threads;
        const auto device = cpu::Device::create(options);
        REQUIRE_FALSE(device);
        CHECK(device.error().message.find(std::to_string(threads)) != std::string::npos);
    }
    cpu::DeviceOptions unknown;
    unknown.isa = cpu::Isa(99);
    const auto device = cpu::Device::create(unknown);
    REQUIRE_FALSE(device);
    CHECK(device.error().code == ErrorCode::unsupported);
}

TEST_CASE("a CPU device has the threads it was asked for, or the engine's") {
    for (int threads : {1, 2, 3, 7}) CHECK(deviceFor(cpu::Isa::automatic, threads).threads() == threads);
    CHECK(deviceFor(cpu::Isa::automatic, 0).threads() >= 1);
    cpu::DeviceOptions options;
    options.parallelFor = [](int count, const std::function<void(int)>& body) {
        for (int i = 0; i < count; ++i) body(i);
    };
    auto device = cpu::Device::create(options);
    REQUIRE(device);
    CHECK(device->threads() == 0);
}

TEST_CASE("the same bits for any number of threads, and for an engine's parallel-for in any order") {
    const Extent2D extent{257, 131};
    CopyFrame reference(extent);
    auto program = deviceFor(cpu::Isa::automatic, 1).compile(copyPlan(extent));
    REQUIRE(program);
    REQUIRE(program->record(reference.inputs()));
    CHECK(reference.result.at(0, 0, 0) == reference.host.at(2, 1, 0));
    for (int threads : {2, 3, 7}) {
        CopyFrame frame(extent);
        auto other = deviceFor(cpu::Isa::automatic, threads).compile(copyPlan(extent));
        REQUIRE(other);
        for (int run = 0; run < 3; ++run) REQUIRE(other->record(frame.inputs()));
        CHECK(sameBits(frame.result, reference.result));
    }
    cpu::DeviceOptions options = withTestKernels();
    int calls = 0;
    options.parallelFor = [&calls](int count, const std::function<void(int)>& body) {
        ++calls;
        for (int i = count - 1; i >= 0; --i) body(i);
    };
    CopyFrame frame(extent);
    auto reversed = cpu::Device::create(options)->compile(copyPlan(extent));
    REQUIRE(reversed);
    REQUIRE(reversed->record(frame.inputs()));
    CHECK(sameBits(frame.result, reference.result));
    CHECK(calls == 2);
}

TEST_CASE("programs of one device outlive it, and their copies of the plan outlive the host's") {
    std::optional<cpu::Program> program;
    {
        Plan plan = copyPlan({20, 5});
        auto compiled = deviceFor(cpu::Isa::automatic, 3).compile(plan);
        REQUIRE(compiled);
        program = std::move(*compiled);
    }
    CopyFrame frame({20, 5});
    CHECK(program->record(frame.inputs()));
    CHECK(program->plan().passes.size() == 2);
    CHECK(frame.result.at(3, 2, 1) == frame.host.at(5, 3, 1));
}

TEST_CASE("timings: a pass each where they were asked for, and none otherwise") {
    for (bool wanted : {false, true}) {
        cpu::DeviceOptions options = withTestKernels();
        options.timings = wanted;
        auto program = cpu::Device::create(options)->compile(copyPlan({20, 5}));
        REQUIRE(program);
        CHECK(program->timings()->empty());
        CopyFrame frame({20, 5});
        for (int run = 0; run < 2; ++run) {
            REQUIRE(program->record(frame.inputs()));
            REQUIRE(program->timings()->size() == (wanted ? 2u : 0u));
        }
        if (wanted) {
            CHECK((*program->timings())[0].label == "copy");
            CHECK((*program->timings())[1].label == "access");
            const auto timings = program->timings();
            for (const PassTiming& t : *timings) CHECK(t.milliseconds >= 0.0);
        }
    }
}

TEST_CASE("transients are read from within the callback behind each pass") {
    auto program = deviceFor(cpu::Isa::automatic).compile(copyPlan({20, 5}));
    REQUIRE(program);
    CopyFrame frame({20, 5});
    std::vector<int> passes;
    std::vector<float> read;
    program->onPass([&](int pass) {
        passes.push_back(pass);
        if (pass == 0) read = floatsOf(*program->read("source"));
    });
    REQUIRE(program->record(frame.inputs()));
    CHECK(passes == std::vector<int>{0, 1});
    CHECK(read == frame.host.values);
    program->onPass({});
    REQUIRE(program->record(frame.inputs()));
    CHECK(passes.size() == 2);
    for (const char* name : {"host", "result", "constants", "nothing", ""}) {
        const auto refused = program->read(name);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::notFound);
    }
}

TEST_CASE("a transient that no pass uses takes no memory and cannot be read") {
    Plan plan = copyPlan({20, 5});
    const size_t before = deviceFor(cpu::Isa::automatic).memoryUse(plan)->total();
    plan.add({"unused", ResourceKind::transient, {}, 4, {4000, 4000}, {}, 0});
    auto program = deviceFor(cpu::Isa::automatic).compile(plan);
    REQUIRE(program);
    CHECK(program->memoryUse().total() == before);
    CHECK_FALSE(program->read("unused"));
}

TEST_CASE("memory use is told before compiling, holds what is compiled, and is zero for what is not valid") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{20, 5}, Extent2D{640, 360}}) {
        Plan plan = copyPlan(e);
        const MemoryUse use = *device.memoryUse(plan);
        auto program = device.compile(plan);
        REQUIRE(program);
        CHECK(program->memoryUse().total() == use.total());
        CHECK(use.transient >= size_t(e.width) * size_t(e.height) * 16);
        CHECK(use.buffers >= sizeof(AccessConstants));
    }
    Plan invalid = copyPlan({20, 5});
    invalid.passes[0].bindings[0].resource = 1 << 20;
    CHECK_FALSE(device.memoryUse(invalid));
    invalid = copyPlan({20, 5});
    invalid.resources[1].extent = {-5, std::numeric_limits<int>::max()};
    CHECK_FALSE(device.memoryUse(invalid));
}

TEST_CASE("plans too large for the machine end in an error") {
    // Sixteen images of the largest size alive at once: 68 GB. Whether the system lends that much address
    // space is its own affair: either answer will do.
    Plan plan{"large", {}, {}};
    const Extent2D largest{maximumExtent, maximumExtent};
    plan.add({"host", ResourceKind::input, {}, 4, largest, {}, 0});
    plan.add(bufferResource("constants", std::vector<AccessConstants>(1)));
    plan.add({"result", ResourceKind::output, {}, 4, largest, {}, 0});
    for (int i = 0; i < 16; ++i) {
        const std::string n = std::to_string(i);
        const auto image = plan.add({"t" + n, ResourceKind::transient, {}, 4, largest, {}, 0});
        plan.passes.push_back(
            {"copy " + n, "copy", {}, {{0, 0}, {1, image, Access::write}, {2, 1}}, largest});
    }
    for (int i = 0; i < 16; ++i)
        plan.passes.push_back({"read " + std::to_string(i),
                               "access",
                               {0},
                               {{0, 3 + i}, {1, 0}, {2, 2, Access::write}, {3, 1}},
                               largest});
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    CHECK(device.memoryUse(plan)->transient >= size_t(16) * 16 * 16384 * 16384);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    MESSAGE("compiling it is left out: sanitizers end the process where an allocation is as large");
#else
    const auto program = device.compile(plan);
    if (!program) CHECK(program.error().code == ErrorCode::outOfMemory);
#endif
}

TEST_CASE("programs of one device run from several threads at once") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic, 3);
    const Extent2D extent{64, 64};
    std::atomic<int> right{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            auto program = device.compile(copyPlan(extent));
            CopyFrame frame(extent);
            for (int run = 0; program && run < 20; ++run) {
                frame.result = Picture(extent, 4, -1.0f);
                if (program->record(frame.inputs()) && frame.result.at(3, 2, 1) == frame.host.at(5, 3, 1) &&
                    frame.result.at(60, 62, 3) == frame.host.at(62, 63, 3))
                    ++right;
            }
        });
    for (std::thread& t : threads) t.join();
    CHECK(right == 80);
}

} // namespace rebound::test
