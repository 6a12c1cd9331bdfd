// SPDX-License-Identifier: MIT
// Buffers of the host, and those of a device's own, on the CPU device and on the one that only records.
#include "kernel_runner.hpp"
#include "sums_technique.hpp"

#include "rebound/recording_device.hpp"

#include <array>

namespace rebound::test {
namespace {

constexpr Extent2D extent{20, 5};
constexpr size_t pixels = 100;

struct CpuSums {
    Picture picture{extent, 1, 3.0f}, shown{extent, 4};
    std::array<float, weightCount> weights{};
    std::vector<float> report = std::vector<float>(pixels);
    cpu::Buffer weightBuffer{weights.data(), sizeof weights, {}},
        reportBuffer{report.data(), report.size() * 4, {}};

    FrameInputs<cpu::Image> inputs() {
        FrameInputs<cpu::Image> inputs;
        inputs.images = {{"picture", picture.image()}, {"shown", shown.image()}};
        inputs.buffers = {{"weights", weightBuffer}, {"report", reportBuffer}};
        return inputs;
    }
};

cpu::Program compiled(const Plan& plan) {
    auto program = deviceFor(cpu::Isa::automatic).compile(plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    return *std::move(program);
}

std::string refusal(cpu::Program& program, const FrameInputs<cpu::Image>& inputs) {
    const auto recorded = program.record(inputs);
    REQUIRE_FALSE(recorded);
    return recorded.error().message;
}

std::string compileRefusal(const Plan& plan) {
    const auto program = deviceFor(cpu::Isa::automatic).compile(plan);
    REQUIRE_FALSE(program);
    return program.error().message;
}

} // namespace

TEST_CASE("CPU: buffers of the host that do not fit are refused, and nothing is run") {
    auto program = compiled(planSums(extent));
    CpuSums sums;
    auto inputs = sums.inputs();
    inputs.buffers[0].buffer.size = 60;
    CHECK(refusal(program, inputs) == "inputs.buffers: weights has 60 bytes; 64 or more were expected");
    inputs = sums.inputs();
    inputs.buffers[1].buffer.data = nullptr;
    CHECK(refusal(program, inputs) == "inputs.buffers: report has no data");
    inputs = sums.inputs();
    inputs.buffers[1].buffer.data = reinterpret_cast<std::byte*>(sums.report.data()) + 1;
    CHECK(refusal(program, inputs) == "inputs.buffers: report is not aligned to 4 bytes");
    inputs = sums.inputs();
    inputs.buffers.pop_back();
    CHECK(refusal(program, inputs) == "inputs: report is missing");
    inputs = sums.inputs();
    inputs.buffers.push_back(inputs.buffers[0]);
    CHECK(refusal(program, inputs) == "inputs.buffers: weights is given twice");
    inputs = sums.inputs();
    inputs.buffers.push_back({"list", sums.weightBuffer});
    CHECK(refusal(program, inputs) ==
          "inputs.buffers: the plan has no input buffer or output buffer named list");
    // None of these was a frame: the next one is the first.
    REQUIRE(program.record(sums.inputs()));
    SumsModel model(pixels);
    CHECK(sums.shown.values == model.run(sums.picture.values, {sums.weights.begin(), sums.weights.end()}));
}

TEST_CASE("CPU: a device's buffer is shared by programs, and lives as long as its handles") {
    const cpu::Device device = deviceFor(cpu::Isa::automatic);
    CpuSums first, second;
    first.weights.fill(2.0f);
    {
        auto shared = device.createBuffer(std::as_bytes(std::span(first.weights)));
        REQUIRE(shared);
        CHECK(shared->data != first.weights.data());
        first.weightBuffer = second.weightBuffer = *shared;
    }
    first.weights.fill(0.0f); // the device has its own
    auto one = compiled(planSums(extent)), other = compiled(planSums(extent));
    REQUIRE(one.record(first.inputs()));
    REQUIRE(other.record(second.inputs()));
    CHECK(first.report == std::vector<float>(pixels, 2.0f));
    CHECK(second.report == first.report);
    const auto empty = device.createBuffer({});
    REQUIRE_FALSE(empty);
    CHECK(empty.error().message == "data is empty; at least one byte was expected");
}

TEST_CASE("CPU: history and persistent buffers are read and replaced between frames") {
    auto program = compiled(planSums(extent));
    CpuSums sums;
    sums.weights.fill(1.0f);
    for (int frame = 0; frame < 3; ++frame) REQUIRE(program.record(sums.inputs()));
    const auto before = program.read("before"), mean = program.read("mean");
    REQUIRE(before);
    REQUIRE(mean);
    CHECK(floatsOf(*before) == std::vector<float>(pixels, 3.0f));
    CHECK(floatsOf(*mean).size() == 4 * pixels);
    CHECK(floatsOf(*mean)[0] == 3.0f); // of a picture that does not change
    auto replaced = floatsOf(*mean);
    for (float& value : replaced) value = 83.0f;
    REQUIRE(program.write("mean", std::as_bytes(std::span(replaced))));
    REQUIRE(program.record(sums.inputs()));
    CHECK(sums.shown.at(0, 0, 0) == 63.0f); // three quarters of 83, one of 3
    CHECK(sums.shown.at(0, 0, 3) == 83.0f);
    CHECK(sums.report[0] == 4.0f);
    CHECK_FALSE(program.write("mean", std::as_bytes(std::span(replaced).first(5))));
    CHECK_FALSE(program.read("report")); // the host's own
}

TEST_CASE("CPU: passes that bind what their kernels do not take are refused") {
    const auto refused = [](auto change) {
        Plan plan = planSums(extent);
        change(plan);
        return compileRefusal(plan);
    };
    CHECK(
        refused([](Plan& p) {
            p.passes[2].features = {0, 1};
        }) ==
        "plan.passes: keep sets the features of sum_keep to 0,1, which is not among the combinations that it "
        "lists");
    CHECK(refused([](Plan& p) {
              p.passes[1].items = 0;
              p.passes[1].grid = extent;
          }) == "plan.passes: items runs sum_items for pixels; items were expected");
    CHECK(refused([](Plan& p) {
              p.passes[4].items = 100;
              p.passes[4].grid = {};
          }) == "plan.passes: show runs sum_show for items; pixels were expected");
    CHECK(refused([](Plan& p) { p.resources[size_t(p.find("list"))].format = Format::r32f; }) ==
          "plan.passes: keys binds list, which is of r32f, to slot 2 of sum_keys, which is of r32ui");
    CHECK(
        refused([](Plan& p) { p.resources[size_t(p.find("keys"))].format = Format::r32f; }) ==
        "plan.passes: keys binds keys, which is r32f, to slot 1 of sum_keys, which takes unsigned integers");
    CHECK(refused([](Plan& p) { p.passes[3].bindings[3].resource = p.find("picture"); }) ==
          "plan.passes: mean binds picture to slot 3 of sum_mean, which does not take it");
    CHECK(refused([](Plan& p) { p.resources[size_t(p.find("report"))].size = 3; }) ==
          "plan.passes: keep binds report, which has 3 bytes, to slot 2 of sum_keep, which takes 4");
}

TEST_CASE("recording: history begins with the first frame, and anew after a reset; buffers are named") {
    recording::Device device;
    auto program = device.compile(planSums(extent));
    REQUIRE(program);
    FrameInputs<recording::Image> inputs;
    inputs.images = {{"picture", {"P", extent}}, {"shown", {"S", extent}}};
    inputs.buffers = {{"weights", {"W", 64}}, {"report", {"R", 400}}};
    for (int frame = 0; frame < 2; ++frame) REQUIRE(program->record(inputs));
    program->reset();
    REQUIRE(program->record(inputs));
    const auto& frames = device.log().frames;
    REQUIRE(frames.size() == 3);
    CHECK_FALSE(frames[0].historyIsValid);
    CHECK(frames[1].historyIsValid);
    CHECK_FALSE(frames[2].historyIsValid);
    CHECK(frames[0].passes[1].items == 100);
    CHECK(frames[0].passes[1].bindings[1].image == "W");
    CHECK(frames[0].passes[2].bindings[2].image == "R");
    CHECK(frames[0].passes[3].bindings[1].access == Access::readPrevious);
    inputs.buffers[1].buffer.size = 399;
    const auto refused = program->record(inputs);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "inputs.buffers: report has 399 bytes; 400 or more were expected");
    CHECK(device.log().liveBytes == memoryUse(planSums(extent))->total());
}

} // namespace rebound::test
