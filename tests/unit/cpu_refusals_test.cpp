// SPDX-License-Identifier: MIT
// What the CPU device refuses.
#include "copy_plan.hpp"

#include <functional>
#include <limits>
#include <optional>

namespace rebound::test {
namespace {

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

TEST_CASE("plans that a CPU device refuses") {
    using enum ErrorCode;
    checkRefusedPlan("runs no/such", notFound, [](Plan& p) { p.passes[0].kernel = "no/such"; });
    checkRefusedPlan("", notFound, [](Plan& p) { p.passes[0].kernel = ""; });
    checkRefusedPlan("slot 9", invalidArgument, [](Plan& p) { p.passes[0].bindings[0].slot = 9; });
    checkRefusedPlan("leaves slot 1 of access unbound", invalidArgument,
                     [](Plan& p) { p.passes[1].bindings.erase(p.passes[1].bindings.begin() + 1); });
    checkRefusedPlan("feature 0 of access to " + std::to_string(accessCount), invalidArgument,
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

} // namespace rebound::test
