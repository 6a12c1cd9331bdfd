// SPDX-License-Identifier: MIT
// A host's logic on a device that runs nothing: which passes and memory settings ask for, resizes, several
// views.
#include "rebound/recording_device.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <optional>
#include <set>

namespace rebound {
namespace {

using recording::Device;
using recording::Image;
using recording::RecordedFrame;

ScreenIndirectSettings settingsFor(Extent2D extent) {
    ScreenIndirectSettings s;
    s.resolution = extent;
    // Few samples nearby: quickly planned.
    s.samplesPerLevel = 4;
    s.ringRadius = 4.0f;
    s.coverScreen = false;
    return s;
}

ScreenIndirectFrame<Image> frameFor(const ScreenIndirectSettings& s) {
    ScreenIndirectFrame<Image> frame;
    frame.camera.projection = glm::perspectiveRH_ZO(1.0f, 1.5f, 0.1f, 100.0f);
    for (auto [image, label] : {std::pair{&frame.depth, "D"},
                                {&frame.normal, "N"},
                                {&frame.radiance, "R"},
                                {&frame.albedo, "A"},
                                {&frame.lit, "L"},
                                {&frame.indirect, "I"},
                                {&frame.composed, "C"}})
        *image = {label, s.resolution};
    return frame;
}

recording::Program compile(const Device& device, const ScreenIndirectSettings& s) {
    auto plan = planScreenIndirect(s);
    REQUIRE(plan);
    auto program = device.compile(*plan);
    REQUIRE(program);
    return std::move(*program);
}

RecordedFrame record(const Device& device, const ScreenIndirectSettings& s) {
    auto program = compile(device, s);
    auto inputs = screenIndirectInputs(s, frameFor(s));
    REQUIRE(inputs);
    const auto recorded = program.record(*inputs);
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    return device.log().frames.back();
}

bool runs(const RecordedFrame& frame, std::string_view kernel) {
    return std::ranges::any_of(frame.passes, [&](const auto& pass) { return pass.kernel == kernel; });
}
int count(const RecordedFrame& frame, std::string_view kernel) {
    return int(std::ranges::count_if(frame.passes, [&](const auto& pass) { return pass.kernel == kernel; }));
}
std::set<std::string> imagesOf(const RecordedFrame& frame, Access access) {
    std::set<std::string> labels;
    for (const auto& pass : frame.passes)
        for (const auto& b : pass.bindings)
            if (b.access == access && !b.image.empty()) labels.insert(b.image);
    return labels;
}

} // namespace

TEST_CASE("recording: outputs that are switched off leave neither passes nor images behind") {
    Device device;
    ScreenIndirectSettings s = settingsFor({640, 360});
    RecordedFrame both = record(device, s);
    CHECK(imagesOf(both, Access::write) == std::set<std::string>{"I", "C"});
    CHECK(runs(both, "screen_indirect/upsample_both"));

    s.compose = false;
    RecordedFrame indirect = record(device, s);
    CHECK(imagesOf(indirect, Access::write) == std::set<std::string>{"I"});
    CHECK(imagesOf(indirect, Access::read) == std::set<std::string>{"D", "N", "R"});
    CHECK(runs(indirect, "screen_indirect/upsample"));

    s.compose = true;
    s.writeIndirect = false;
    RecordedFrame composed = record(device, s);
    CHECK(imagesOf(composed, Access::write) == std::set<std::string>{"C"});
    CHECK(imagesOf(composed, Access::read) == std::set<std::string>{"A", "D", "L", "N", "R"});
    CHECK(runs(composed, "screen_indirect/upsample_compose"));
}

TEST_CASE("recording: one gather a level, each at half the resolution of the one before, from the start "
          "resolution on") {
    Device device;
    const std::pair<StartResolution, int> starts[] = {
        {StartResolution::full, 1}, {StartResolution::half, 2}, {StartResolution::quarter, 4}};
    for (auto [start, divisor] : starts)
        for (int levels = 1; levels <= 8; ++levels) {
            ScreenIndirectSettings s = settingsFor({641, 359});
            s.start = start;
            s.levels = levels;
            const RecordedFrame frame = record(device, s);
            CHECK(count(frame, "screen_indirect/gather") == levels);
            CHECK(count(frame, "screen_indirect/combine") == levels - 1);
            std::set<std::pair<int, int>> expected, seen;
            for (int k = 0, d = divisor; k < levels; ++k, d *= 2)
                expected.insert({(641 + d - 1) / d, (359 + d - 1) / d});
            for (const auto& pass : frame.passes)
                if (pass.kernel == "screen_indirect/gather") seen.insert({pass.grid.width, pass.grid.height});
            CHECK(seen == expected);
        }
}

TEST_CASE("recording: a level alone is gathered alone, and neither it nor finer ones are gathered twice") {
    Device device;
    for (int levels = 1; levels <= 8; ++levels)
        for (int only = 0; only < levels; ++only) {
            ScreenIndirectSettings s = settingsFor({640, 360});
            s.levels = levels;
            s.onlyLevel = only;
            const RecordedFrame frame = record(device, s);
            CHECK(count(frame, "screen_indirect/gather") == 1);
            for (const auto& pass : frame.passes)
                if (pass.kernel == "screen_indirect/gather") {
                    const int divisor = 4 << only;
                    CHECK(pass.grid ==
                          Extent2D{(640 + divisor - 1) / divisor, (360 + divisor - 1) / divisor});
                }
        }
}

TEST_CASE("recording: every variant's transients lie apart while both are in use") {
    Device device;
    for (StartResolution start : {StartResolution::full, StartResolution::half, StartResolution::quarter})
        for (int levels = 1; levels <= 8; ++levels)
            for (int outputs = 1; outputs <= 3; ++outputs) {
                ScreenIndirectSettings s = settingsFor({333, 77});
                s.start = start;
                s.levels = levels;
                s.writeIndirect = outputs & 1;
                s.compose = outputs & 2;
                auto plan = planScreenIndirect(s);
                REQUIRE(plan);
                const RecordedFrame frame = record(device, s);
                const auto lives = lifetimes(*plan);
                std::vector<std::optional<recording::BoundResource>> transients(plan->resources.size());
                for (const auto& pass : frame.passes)
                    for (const auto& b : pass.bindings) {
                        const auto i = size_t(plan->find(b.resource));
                        if (plan->resources[i].kind == ResourceKind::transient) transients[i] = b;
                    }
                for (size_t a = 0; a < transients.size(); ++a)
                    for (size_t b = 0; b < a; ++b)
                        if (transients[a] && transients[b] && lives[a].first <= lives[b].last &&
                            lives[b].first <= lives[a].last)
                            CHECK((transients[a]->offset + transients[a]->size <= transients[b]->offset ||
                                   transients[b]->offset + transients[b]->size <= transients[a]->offset));
            }
}

TEST_CASE("recording: memory is known before it is allocated, and given back") {
    Device device;
    const ScreenIndirectSettings s = settingsFor({1280, 720});
    auto plan = planScreenIndirect(s);
    REQUIRE(plan);
    const MemoryUse before = *device.memoryUse(*plan);
    CHECK(before.transient > 0);
    CHECK(before.transient < before.transientUnshared);
    {
        auto program = compile(device, s);
        CHECK(program.memoryUse().total() == before.total());
        CHECK(device.log().liveBytes == before.total());
        size_t allocated = 0;
        for (const auto& a : device.log().allocations) allocated += a.size;
        CHECK(allocated == before.total());
    }
    CHECK(device.log().liveBytes == 0);
    CHECK(device.log().livePrograms == 0);
}

TEST_CASE("recording: a resize is a new plan, and leaves nothing of the old one") {
    Device device;
    std::optional<recording::Program> program;
    for (int width : {1280, 640, 1920, 1, 333}) {
        const ScreenIndirectSettings s = settingsFor({width, 360});
        program.reset();
        program = compile(device, s);
        CHECK(device.log().livePrograms == 1);
        CHECK(device.log().liveBytes == program->memoryUse().total());
        auto stale = screenIndirectInputs(s, frameFor(settingsFor({width + 1, 360})));
        REQUIRE(stale);
        const size_t frames = device.log().frames.size();
        const auto refused = program->record(*stale);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message.find(std::to_string(width) + "x360 was expected") != std::string::npos);
        CHECK(device.log().frames.size() == frames);
        auto inputs = screenIndirectInputs(s, frameFor(s));
        REQUIRE(inputs);
        CHECK(program->record(*inputs));
    }
    // Moving one program over another gives the other's memory back.
    *program = compile(device, settingsFor({64, 64}));
    CHECK(device.log().livePrograms == 1);
    CHECK(device.log().liveBytes == program->memoryUse().total());
    CHECK(device.log().peakBytes >= device.log().liveBytes);
}

TEST_CASE("recording: several views, each a program of its own, with cameras of their own") {
    Device device;
    const ScreenIndirectSettings main = settingsFor({1280, 720}), mirror = settingsFor({320, 320});
    auto mainProgram = compile(device, main), mirrorProgram = compile(device, mirror);
    CHECK(device.log().livePrograms == 2);
    auto mainFrame = frameFor(main), mirrorFrame = frameFor(mirror);
    mirrorFrame.camera.projection = glm::perspectiveRH_ZO(0.5f, 1.0f, 0.1f, 100.0f);
    mirrorFrame.depth.label = "mirror's depth";
    REQUIRE(mainProgram.record(*screenIndirectInputs(main, mainFrame)));
    REQUIRE(mirrorProgram.record(*screenIndirectInputs(mirror, mirrorFrame)));
    REQUIRE(mainProgram.record(*screenIndirectInputs(main, mainFrame)));
    const auto& frames = device.log().frames;
    REQUIRE(frames.size() == 3);
    CHECK(imagesOf(frames[1], Access::read).contains("mirror's depth"));
    CHECK_FALSE(imagesOf(frames[2], Access::read).contains("mirror's depth"));
    REQUIRE(frames[0].constants.size() == 1);
    CHECK(frames[0].constants[0].name == "camera");
    CHECK(frames[0].constants[0].data == frames[2].constants[0].data);
    CHECK(frames[0].constants[0].data != frames[1].constants[0].data);
}

TEST_CASE("recording: what a frame lacks, repeats or does not need is named") {
    Device device;
    const ScreenIndirectSettings s = settingsFor({64, 64});
    auto program = compile(device, s);
    auto complete = screenIndirectInputs(s, frameFor(s));
    REQUIRE(complete);
    for (size_t i = 0; i < complete->images.size(); ++i) {
        FrameInputs<Image> inputs = *complete;
        const std::string name(inputs.images[i].name);
        inputs.images.erase(inputs.images.begin() + ptrdiff_t(i));
        const auto refused = program.record(inputs);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message == "inputs: " + name + " is missing");
        inputs = *complete;
        inputs.images.push_back(inputs.images[i]);
        CHECK_FALSE(program.record(inputs));
    }
    FrameInputs<Image> inputs = *complete;
    inputs.images.push_back({"motion", {"M", {64, 64}}});
    CHECK(program.record(inputs).error().message.find("motion") != std::string::npos);
    inputs = *complete;
    inputs.images.push_back({"surface 0", {"S", {64, 64}}});
    CHECK(program.record(inputs).error().message.find("surface 0") != std::string::npos);
    inputs = *complete;
    inputs.constants.clear();
    CHECK(program.record(inputs).error().message == "inputs: camera is missing");
    inputs = *complete;
    inputs.constants[0].data.pop_back();
    CHECK(program.record(inputs).error().message.find("95 bytes; 96 were expected") != std::string::npos);
    inputs = *complete;
    inputs.constants.push_back({"depth", {}});
    CHECK_FALSE(program.record(inputs));
    inputs = *complete;
    inputs.constants.push_back(inputs.constants[0]);
    CHECK_FALSE(program.record(inputs));
    CHECK(device.log().frames.empty());
    CHECK(program.record(*complete));
}

TEST_CASE("recording: a device short of memory, or of a kernel, refuses and stays as it was") {
    auto plan = planScreenIndirect(settingsFor({640, 360}));
    REQUIRE(plan);
    const size_t needed = memoryUse(*plan)->total();
    Device device({needed + needed / 2, {}});
    {
        auto first = device.compile(*plan);
        REQUIRE(first);
        auto second = device.compile(*plan);
        REQUIRE_FALSE(second);
        CHECK(second.error().code == ErrorCode::outOfMemory);
        CHECK(device.log().liveBytes == needed);
        CHECK(device.log().livePrograms == 1);
    }
    CHECK(device.compile(*plan));
    CHECK_FALSE(Device({needed - 1, {}}).compile(*plan));

    const Device bare({std::numeric_limits<size_t>::max(), {"some/other"}});
    const auto refused = bare.compile(*plan);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::notFound);
    CHECK(bare.log().allocations.empty());

    Plan spoilt = *plan;
    spoilt.passes[0].bindings[0].resource = 1000;
    CHECK_FALSE(device.compile(spoilt));
}

} // namespace rebound
