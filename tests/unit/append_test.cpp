// SPDX-License-Identifier: MIT
// Plans behind plans: what is shared, what is kept apart, and what is refused.
#include "rebound/device.hpp"

#include <doctest/doctest.h>

namespace rebound {
namespace {

// depth -> measure -> result, by a table and a camera, with history.
Plan technique(Extent2D extent, std::string result = "result") {
    Plan plan{"one", {}, {}};
    const auto depth = plan.add({"depth", ResourceKind::input, Format::r32f, 1, extent, {}, 0});
    const auto out = plan.add({std::move(result), ResourceKind::output, Format::rgba16f, 3, extent, {}, 0});
    const auto mean = plan.add({"mean", ResourceKind::history, Format::rgba16f, 3, extent, {}, 0});
    const auto links = plan.add({"links", ResourceKind::inputBuffer, Format::r32f, 1, {}, {}, 64});
    const auto camera = plan.add({"camera", ResourceKind::frameConstants, {}, 1, {}, {}, 96});
    const auto table = plan.add(bufferResource("table", std::vector<float>{1, 2}));
    const auto frames = plan.add(frameStateResource());
    plan.passes.push_back({"measure",
                           "k",
                           {},
                           {{0, depth},
                            {1, out, Access::write},
                            {2, mean, Access::readPrevious},
                            {3, mean, Access::write},
                            {4, links},
                            {5, camera},
                            {6, table},
                            {7, frames}},
                           extent});
    return plan;
}

std::string refusal(Plan plan, const Plan& appended, const AppendOptions& options) {
    const std::string before = toText(plan);
    const auto done = append(plan, appended, options);
    REQUIRE_FALSE(done);
    CHECK(toText(plan) == before);
    return done.error().message;
}

} // namespace

TEST_CASE(
    "appended: what the host hands in under one name is one, and what a plan has of its own is its own") {
    Plan plan = technique({8, 4});
    REQUIRE(append(plan, technique({8, 4}, "other"), {"b ", "", {}}));
    CHECK(toText(plan) ==
          "plan one + one\n"
          "resource depth: input 8x4 r32f, 1 channel\n"
          "resource result: output 8x4 rgba16f, 3 channels\n"
          "resource mean: history 8x4 rgba16f, 3 channels\n"
          "resource links: input buffer 64 bytes\n"
          "resource camera: frame constants 96 bytes\n"
          "resource table: buffer 8 bytes\n"
          "resource frame state: frame state 16 bytes\n"
          "resource other: output 8x4 rgba16f, 3 channels\n"
          "resource b mean: history 8x4 rgba16f, 3 channels\n"
          "resource b table: buffer 8 bytes\n"
          "pass measure: k for 8x4, reads depth, writes result, reads previous mean, writes mean, "
          "reads links, reads camera, reads table, reads frame state\n"
          "pass b measure: k for 8x4, reads depth, writes other, reads previous b mean, writes b mean, "
          "reads links, reads camera, reads b table, reads frame state\n");
}

TEST_CASE("appended: the larger of two wants is asked of the host") {
    Plan wide = technique({8, 4}, "other");
    wide.resources[0].channels = 4;
    wide.resources[3].size = 100;
    Plan plan = technique({8, 4});
    REQUIRE(append(plan, wide, {"b ", "", {}}));
    CHECK(plan.resources[0].channels == 4);
    CHECK(plan.resources[3].size == 100);
}

TEST_CASE("appended for another camera: nothing is shared but what is bound") {
    Plan plan;
    REQUIRE(append(plan, technique({8, 4}), {"left ", "left ", {}}));
    REQUIRE(append(plan, technique({16, 9}), {"right ", "right ", {{"links", "left links"}}}));
    CHECK(plan.resources.size() == 7 + 5); // links and frame state are shared
    CHECK(plan.find("right links") == -1);
    CHECK(plan.passes[1].label == "right measure");
    CHECK(plan.passes[1].bindings[4].resource == plan.find("left links"));
    CHECK(plan.technique == "one + one");
}

TEST_CASE("appended: an output is an input, kept inside if wanted") {
    Plan plan = technique({8, 4});
    REQUIRE(append(plan, technique({8, 4}, "other"), {"b ", "", {{"depth", "result"}}}));
    CHECK(plan.passes[1].bindings[0].resource == plan.find("result"));
    REQUIRE(keepInside(plan, "result"));
    CHECK(plan.resources[size_t(plan.find("result"))].kind == ResourceKind::transient);
    CHECK(validate(plan));
    for (const char* name : {"result", "depth", "nothing"}) {
        const auto refused = keepInside(plan, name);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message ==
              std::string("output is ") + name + ", which is no output of the plan");
    }
}

TEST_CASE("appended plans that do not fit are refused, and change nothing") {
    const Plan plan = technique({8, 4});
    CHECK(refusal(plan, technique({8, 4}), {"b ", "", {}}) ==
          "append: both plans have result; a prefix that tells them apart was expected");
    CHECK(refusal(plan, technique({8, 4}, "other"), {"", "", {}}) ==
          "append: both plans have mean; a prefix that tells them apart was expected");
    CHECK(refusal(plan, technique({16, 9}, "other"), {"b ", "", {}}) ==
          "append: depth is input of 8x4 r32f in one plan and input of 16x9 r32f in the other; a host prefix "
          "that "
          "tells them apart was expected");
    Plan other = technique({8, 4}, "other");
    other.resources[4].size = 112;
    CHECK(refusal(plan, other, {"b ", "", {}}) == "append: camera is frame constants of 96 bytes in one plan "
                                                  "and frame constants of 112 bytes in the other; a "
                                                  "host prefix that tells them apart was expected");
    other = technique({8, 4}, "other");
    CHECK(refusal(plan, other, {"b ", "", {{"mean", "mean"}}}) ==
          "append: bindings name mean, which is no input of the appended plan");
    CHECK(refusal(plan, other, {"b ", "", {{"depth", "nothing"}}}) ==
          "append: bindings bind depth to nothing, which the plan does not have");
    CHECK(refusal(plan, other, {"b ", "", {{"depth", "links"}}}) ==
          "append: depth, which is input of 8x4 r32f, is bound to links, which is input buffer of 64 bytes");
    CHECK(refusal(plan, technique({16, 9}, "other"), {"b ", "", {{"depth", "result"}}}) ==
          "append: depth, which is input of 16x9 r32f, is bound to result, which is output of 8x4 rgba16f");
    other.resources[3].size = 65;
    CHECK(refusal(plan, other, {"b ", "", {{"links", "links"}}}) ==
          "append: links, which is input buffer of 65 bytes, is bound to links, which is input buffer of 64 "
          "bytes");
    Plan labelled = technique({8, 4}, "other");
    labelled.resources.erase(labelled.resources.begin() + 2, labelled.resources.end());
    labelled.passes[0].bindings.resize(2);
    CHECK(refusal(plan, labelled, {"", "", {}}) ==
          "append: both plans have a pass labelled measure; a prefix that tells them apart was expected");
    other.passes[0].grid = {};
    CHECK(refusal(plan, other, {"b ", "", {}}).starts_with("plan.passes: measure runs for 0x0"));
}

TEST_CASE("inputs are joined as their plans are") {
    struct Picture {
        int number = 0;
    };
    const auto bytes = [](int value) { return std::vector<std::byte>{std::byte(value)}; };
    FrameInputs<Picture> inputs{{{"depth", {1}}, {"result", {2}}}, {{"camera", bytes(7)}}, {}};
    const FrameInputs<Picture> other{
        {{"depth", {3}}, {"other", {4}}, {"light", {}}}, {{"camera", bytes(7)}}, {}};
    REQUIRE(append(inputs, other, {"b ", "", {{"light", "result"}}}));
    REQUIRE(inputs.images.size() == 3);
    CHECK(inputs.images[0].image.number == 1);
    CHECK(inputs.images[2].name == "other");
    CHECK(inputs.constants.size() == 1);
    REQUIRE(append(inputs, other, {"b ", "right ", {{"light", "result"}}}));
    CHECK(inputs.images.size() == 5);
    CHECK(inputs.images[3].name == "right depth");
    CHECK(inputs.constants.size() == 2);
    const FrameInputs<Picture> elsewhere{{}, {{"camera", bytes(8)}}, {}};
    const auto refused = append(inputs, elsewhere);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message ==
          "append: the frame constants camera differ between the plans' inputs; equal ones, "
          "or a host prefix that tells them apart, were expected");
    CHECK(inputs.constants.size() == 2);
}

} // namespace rebound
