// SPDX-License-Identifier: MIT
// The CPU device: what it refuses, and how it runs what it accepts.
#include "kernel_runner.hpp"

#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <thread>

namespace rebound::test {
namespace {

// host -> copy -> source -> access -> result
Plan copyPlan(Extent2D extent) {
    const AccessConstants k{{extent.width, extent.height, 0, 0}, {0, 0, 0, 0}};
    Plan plan{"test", {}, {}};
    plan.add({"host", ResourceKind::input, {}, 4, extent, {}, 0});
    plan.add({"source", ResourceKind::transient, {}, 4, extent, {}, 0});
    plan.add({"result", ResourceKind::output, {}, 4, extent, {}, 0});
    plan.add({"grid", ResourceKind::frameConstants, {}, 1, {}, {}, sizeof(AccessConstants)});
    plan.add(bufferResource("constants", std::vector{k}));
    plan.passes.push_back({"copy", "copy", {}, {{0, 0}, {1, 1, Access::write}, {2, 4}}, extent});
    plan.passes.push_back(
        {"access", "access", {accessOffset}, {{0, 1}, {1, 0}, {2, 2, Access::write}, {3, 3}}, extent});
    return plan;
}

struct CopyFrame {
    Picture host, result;
    AccessConstants constants;

    explicit CopyFrame(Extent2D extent)
        : host(numbered(extent)),
          result(extent, 4, -1.0f), constants{{extent.width, extent.height, 0, 0}, {2, 1, 0, 0}} {}
    FrameInputs<cpu::Image> inputs() {
        return {{{"host", host.image()}, {"result", result.image()}}, {{"grid", bytesOf(constants)}}};
    }
};

cpu::DeviceOptions withTestKernels() {
    cpu::DeviceOptions options;
    options.threads = 2;
    options.moreKernels = {cpu::testKernels};
    return options;
}

void checkRefusedPlan(const std::string& part, ErrorCode code, const std::function<void(Plan&)>& spoil) {
    Plan plan = copyPlan({20, 5});
    spoil(plan);
    const auto program = deviceFor(cpu::Isa::automatic).compile(plan);
    CAPTURE(part);
    REQUIRE_FALSE(program);
    CHECK(program.error().code == code);
    INFO(program.error().message);
    CHECK(program.error().message.find(part) != std::string::npos);
}

void checkRefusedFrame(const std::string& part, const std::function<void(FrameInputs<cpu::Image>&)>& spoil) {
    auto program = deviceFor(cpu::Isa::automatic).compile(copyPlan({20, 5}));
    REQUIRE(program);
    CopyFrame frame({20, 5});
    auto inputs = frame.inputs();
    spoil(inputs);
    const auto recorded = program->record(inputs);
    CAPTURE(part);
    REQUIRE_FALSE(recorded);
    CHECK(recorded.error().code == ErrorCode::invalidArgument);
    INFO(recorded.error().message);
    CHECK(recorded.error().message.find(part) != std::string::npos);
    CHECK(frame.result.values == Picture({20, 5}, 4, -1.0f).values);
}

} // namespace

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

TEST_CASE("plans that a CPU device refuses") {
    using enum ErrorCode;
    checkRefusedPlan("runs no/such", notFound, [](Plan& p) { p.passes[0].kernel = "no/such"; });
    checkRefusedPlan("", notFound, [](Plan& p) { p.passes[0].kernel = ""; });
    checkRefusedPlan("slot 9", invalidArgument, [](Plan& p) { p.passes[0].bindings[0].slot = 9; });
    checkRefusedPlan("leaves slot 1 of access unbound", invalidArgument,
                     [](Plan& p) { p.passes[1].bindings.erase(p.passes[1].bindings.begin() + 1); });
    checkRefusedPlan("feature 0 of access to 10", invalidArgument,
                     [](Plan& p) { p.passes[1].features = {accessCount}; });
    checkRefusedPlan("feature 0 of access to -1", invalidArgument,
                     [](Plan& p) { p.passes[1].features = {-1}; });
    checkRefusedPlan("feature 1 of access to 1", invalidArgument, [](Plan& p) {
        p.passes[1].features = {0, 1};
    });
    checkRefusedPlan("which does not take it", invalidArgument,
                     [](Plan& p) { p.passes[1].bindings[0].resource = 0; });
    checkRefusedPlan("which does not take it", invalidArgument,
                     [](Plan& p) { p.passes[0].bindings[2].resource = 0; });
    checkRefusedPlan("size is not that of the pass's grid", invalidArgument, [](Plan& p) {
        p.passes[0].grid = {19, 5};
    });
    checkRefusedPlan("size is not that of the pass's grid", invalidArgument, [](Plan& p) {
        p.resources[2].extent = {40, 5};
    });
    checkRefusedPlan("which takes 32", invalidArgument, [](Plan& p) { p.resources[3].size = 31; });
    checkRefusedPlan("which takes 16", invalidArgument,
                     [](Plan& p) { p.resources[4] = bufferResource("constants", std::vector<float>{1.0f}); });
    checkRefusedPlan(
        "binds source, which is 19x5, to slot 0 of fetch, which reads it at every pixel of a grid "
        "of 20x5",
        invalidArgument, [](Plan& p) {
            p.resources[1].extent = p.passes[0].grid = {19, 5};
            p.passes[1].kernel = "fetch";
            p.passes[1].features = {};
            p.passes[1].bindings = {{0, 1}, {1, 2, Access::write}, {2, 4}};
        });
    checkRefusedPlan("used twice", invalidArgument, [](Plan& p) { p.passes[1].label = "copy"; });
}

TEST_CASE("frames that a CPU device refuses, writing nothing") {
    using Inputs = FrameInputs<cpu::Image>;
    checkRefusedFrame("host is missing", [](Inputs& i) { i.images.erase(i.images.begin()); });
    checkRefusedFrame("result is missing", [](Inputs& i) { i.images.pop_back(); });
    checkRefusedFrame("grid is missing", [](Inputs& i) { i.constants.clear(); });
    checkRefusedFrame("31 bytes; 32 were expected", [](Inputs& i) { i.constants[0].data.pop_back(); });
    checkRefusedFrame("no frame constants named constants", [](Inputs& i) {
        i.constants.push_back({"constants", {}});
    });
    checkRefusedFrame("named source", [](Inputs& i) { i.images.push_back({"source", i.images[0].image}); });
    checkRefusedFrame("named other", [](Inputs& i) { i.images.push_back({"other", i.images[0].image}); });
    checkRefusedFrame("host is given twice", [](Inputs& i) { i.images.push_back(i.images[0]); });
    checkRefusedFrame("grid is given twice", [](Inputs& i) { i.constants.push_back(i.constants[0]); });
    checkRefusedFrame("host has no data", [](Inputs& i) { i.images[0].image.data = nullptr; });
    checkRefusedFrame("20x4; 20x5 was expected", [](Inputs& i) { i.images[0].image.extent.height = 4; });
    for (int channels : {0, -1, 3, 5})
        checkRefusedFrame("channels; 4 to 4 were expected",
                          [&](Inputs& i) { i.images[0].image.channels = channels; });
    checkRefusedFrame("host has a pixel stride of 6 bytes; a multiple of 4",
                      [](Inputs& i) { i.images[0].image.pixelStride = 6; });
    checkRefusedFrame("channel stride of 2 bytes; a multiple of 4",
                      [](Inputs& i) { i.images[0].image.channelStride = 2; });
    checkRefusedFrame("row stride of 161 bytes; a multiple of 2", [](Inputs& i) {
        i.images[0].image.scalar = cpu::Scalar::float16;
        i.images[0].image.rowStride = 161;
    });
    constexpr ptrdiff_t most = std::numeric_limits<ptrdiff_t>::max() - 3,
                        least = std::numeric_limits<ptrdiff_t>::min();
    for (ptrdiff_t far : {most, least})
        checkRefusedFrame("row stride of " + std::to_string(far),
                          [far](Inputs& i) { i.images[0].image.rowStride = far; });
    checkRefusedFrame(
        "host has misaligned data: its address is 1 byte behind a multiple of 4",
        [](Inputs& i) { i.images[0].image.data = static_cast<char*>(i.images[0].image.data) + 1; });
}

TEST_CASE("layouts that a CPU device refuses: texels on each other") {
    using Inputs = FrameInputs<cpu::Image>;
    // Interleaved, 20x5, 4 channels of 4 bytes.
    for (size_t which : {size_t(0), size_t(1)}) {
        const std::string name = which == 0 ? "host" : "result";
        for (ptrdiff_t stride : {ptrdiff_t(0), ptrdiff_t(4), ptrdiff_t(-12)})
            checkRefusedFrame(name + " has a pixel stride of " + std::to_string(stride) + " bytes",
                              [=](Inputs& i) { i.images[which].image.pixelStride = stride; });
        checkRefusedFrame(name + " has a row stride of 80 bytes, in which its texels lie on each other; at "
                                 "least 320 bytes were expected",
                          [=](Inputs& i) { i.images[which].image.rowStride = 20 * 4; });
        checkRefusedFrame(name + " has a row stride of -316 bytes",
                          [=](Inputs& i) { i.images[which].image.rowStride = -316; });
        checkRefusedFrame(name + " has a row stride of 0 bytes",
                          [=](Inputs& i) { i.images[which].image.rowStride = 0; });
    }
    checkRefusedFrame("result has a channel stride of 0 bytes",
                      [](Inputs& i) { i.images[1].image.channelStride = 0; });
    // A plane a channel, each short of its last row.
    checkRefusedFrame("host has a channel stride of 320 bytes", [](Inputs& i) {
        cpu::Image& image = i.images[0].image;
        image = cpu::planarImage(image.data, image.extent, 4);
        image.channelStride = 320;
    });
}

TEST_CASE("outputs that share memory are refused, and those that only lie between others are not") {
    constexpr Extent2D half{10, 5};
    auto program = deviceFor(cpu::Isa::automatic).compile(copyPlan(half));
    REQUIRE(program);
    std::vector<float> memory(20 * 5 * 8);
    const auto record = [&](const cpu::Image& host, const cpu::Image& result) {
        const AccessConstants k{{half.width, half.height, 0, 0}, {0, 0, 0, 0}};
        return program->record({{{"host", host}, {"result", result}}, {{"grid", bytesOf(k)}}});
    };
    const auto at = [&](size_t first, ptrdiff_t pixel, ptrdiff_t row, ptrdiff_t channel) {
        return cpu::Image{
            memory.data() + first, half, 4, cpu::Scalar::float32, 4 * pixel, 4 * row, 4 * channel};
    };
    const cpu::Image left = at(0, 4, 80, 1), right = at(40, 4, 80, 1), oneFurther = at(36, 4, 80, 1);
    CHECK(record(left, right));
    CHECK(record(right, left));
    CHECK(record(at(0, 8, 80, 1), at(4, 8, 80, 1)));       // pixels of eight channels, four each
    CHECK(record(at(0, 1, 10, 100), at(50, 1, 10, 100)));  // planes of one between those of the other
    CHECK(record(at(320, 4, -80, 1), at(360, 4, -80, 1))); // from the bottom up
    CHECK(record(at(0, 4, 40, 1), at(200, 4, 40, 1)));     // one behind the other
    for (const auto& [host, result] :
         {std::pair{left, left}, std::pair{left, oneFurther}, std::pair{oneFurther, left},
          std::pair{left, at(320, 4, -80, 1)}, std::pair{at(0, 8, 80, 1), at(3, 8, 80, 1)},
          std::pair{at(0, 4, 40, 1), at(196, 4, 40, 1)}}) {
        const auto refused = record(host, result);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message ==
              "inputs.images: result and host share memory; an output of its own was expected");
    }
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
