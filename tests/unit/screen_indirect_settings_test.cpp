// SPDX-License-Identifier: MIT
// Settings of screen_indirect: ranges, presets, covering radius.
#include "rebound/techniques/screen_indirect.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace rebound {
namespace {

void checkRefused(const std::string& part, const std::function<void(ScreenIndirectSettings&)>& spoil) {
    ScreenIndirectSettings s;
    s.resolution = {1280, 720};
    REQUIRE(planScreenIndirect(s));
    spoil(s);
    const auto plan = planScreenIndirect(s);
    CAPTURE(part);
    REQUIRE_FALSE(plan);
    CHECK(plan.error().code == ErrorCode::invalidArgument);
    INFO(plan.error().message);
    CHECK(plan.error().message.find(part) != std::string::npos);
}

} // namespace

TEST_CASE("settings out of their range are named with their value and what was expected") {
    using Settings = ScreenIndirectSettings;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
    CHECK_FALSE(planScreenIndirect({}));
    for (Extent2D e : {Extent2D{0, 720}, Extent2D{1280, -1}, Extent2D{16385, 1},
                       Extent2D{1, std::numeric_limits<int>::max()}})
        checkRefused("settings.resolution is", [e](Settings& s) { s.resolution = e; });
    checkRefused("settings.resolution is 0x720; 1x1 to 16384x16384 was expected",
                 [](Settings& s) { s.resolution.width = 0; });
    for (int levels : {0, -1, 9, std::numeric_limits<int>::max()})
        checkRefused("; 1 to 8 was expected", [=](Settings& s) { s.levels = levels; });
    checkRefused("settings.levels is 9", [](Settings& s) { s.levels = 9; });
    for (int samples : {3, 257, -64, 0, wholeRings - 1})
        checkRefused("settings.samplesPerLevel is", [=](Settings& s) { s.samplesPerLevel = samples; });
    for (float radius : {0.99f, 1025.0f, -1.0f, nan, inf})
        checkRefused("settings.ringRadius is", [=](Settings& s) { s.ringRadius = radius; });
    for (float cosine : {0.0f, 1.01f, -0.5f, nan, inf})
        checkRefused("settings.minimumCosine is", [=](Settings& s) { s.minimumCosine = cosine; });
    checkRefused("settings.onlyLevel is 4", [](Settings& s) { s.onlyLevel = 4; });
    checkRefused("settings.onlyLevel is -1", [](Settings& s) { s.onlyLevel = -1; });
    checkRefused("one output was expected", [](Settings& s) { s.writeIndirect = s.compose = false; });
}

TEST_CASE("settings at the ends of their ranges are accepted") {
    ScreenIndirectSettings s;
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{16384, 16384}, Extent2D{1, 16384}})
        for (int levels : {1, 8})
            for (int samples : {4, 256})
                for (float radius : {1.0f, 1024.0f})
                    for (float cosine : {0.001f, 1.0f}) {
                        // The widest ring takes its time to choose samples from.
                        if (radius > 1.0f && (e.height > 1 || levels > 1 || samples > 4)) continue;
                        s.resolution = e;
                        s.levels = levels;
                        s.samplesPerLevel = samples;
                        s.ringRadius = radius;
                        s.minimumCosine = cosine;
                        s.coverScreen = false;
                        s.onlyLevel = levels - 1;
                        auto plan = planScreenIndirect(s);
                        REQUIRE(plan);
                        CHECK(validate(*plan));
                    }
}

TEST_CASE("whole rings take every texel of every ring") {
    ScreenIndirectSettings s;
    s.resolution = {96, 64};
    s.ringRadius = 10.0f;
    s.levels = 2;
    s.samplesPerLevel = wholeRings;
    const auto plan = planScreenIndirect(s);
    REQUIRE(plan);
    for (auto [level, ring, extent] : {std::tuple{0, Ring{10.0f, true, false}, Extent2D{24, 16}},
                                       {1, Ring{10.0f, false, true}, Extent2D{12, 8}}}) {
        const ResourceIndex index = plan->find("gather level " + std::to_string(level) + " ring");
        REQUIRE(index >= 0);
        CHECK(plan->resources[size_t(index)].size ==
              ringTexels(ring, extent).size() * sizeof(detail::RingSample));
    }
}

TEST_CASE("a plan's inputs and outputs are the documented ones, at the G-buffer's resolution") {
    ScreenIndirectSettings s;
    s.resolution = {641, 359};
    auto plan = planScreenIndirect(s);
    REQUIRE(plan);
    CHECK(plan->technique == "screen_indirect");
    for (const char* name : {"depth", "normal", "radiance", "albedo", "lit"}) {
        REQUIRE(plan->find(name) >= 0);
        CHECK(plan->resources[size_t(plan->find(name))].kind == ResourceKind::input);
        CHECK(plan->resources[size_t(plan->find(name))].extent == s.resolution);
    }
    for (const char* name : {"indirect", "composed"}) {
        REQUIRE(plan->find(name) >= 0);
        CHECK(plan->resources[size_t(plan->find(name))].kind == ResourceKind::output);
        CHECK(plan->resources[size_t(plan->find(name))].extent == s.resolution);
    }
    CHECK(toText(*plan) == toText(*planScreenIndirect(s)));
}

TEST_CASE("presets: each by its name, at every resolution") {
    REQUIRE(screenIndirectPresetNames().size() == 8);
    for (std::string_view name : screenIndirectPresetNames())
        for (Extent2D e : {Extent2D{1280, 720}, Extent2D{640, 360}, Extent2D{3840, 2160}, Extent2D{1, 1}}) {
            CAPTURE(name);
            auto s = screenIndirectPreset(name, e);
            REQUIRE(s);
            CHECK(s->resolution == e);
            CHECK((s->start == StartResolution::half) == name.starts_with("half"));
            CHECK((s->start == StartResolution::quarter) == name.starts_with("quarter"));
            CHECK(s->samplesPerLevel == (name.find("256") != std::string_view::npos ? 256 : 64));
            CHECK(s->levels == (name.ends_with("-5") ? 5 : 4));
            // 40 texels at 720 rows, and the same part of the view at others.
            const float expected = std::max(1.0f, 40.0f * float(e.height) / 720.0f);
            CHECK(s->ringRadius == doctest::Approx(expected).epsilon(1e-6)); // one rounding
        }
    CHECK(planScreenIndirect(*screenIndirectPreset("half-64", {1280, 720})));
    CHECK_FALSE(planScreenIndirect(*screenIndirectPreset("half-64", {0, 0})));
    for (const char* unknown : {"", "quarter", "Quarter-64", "quarter-64 "}) {
        const auto s = screenIndirectPreset(unknown, {64, 64});
        REQUIRE_FALSE(s);
        CHECK(s.error().code == ErrorCode::notFound);
        for (std::string_view name : screenIndirectPresetNames())
            CHECK(s.error().message.find(name) != std::string::npos);
    }
}

TEST_CASE("the covering radius is the smallest whole one whose outermost ring spans the start resolution's "
          "diagonal") {
    ScreenIndirectSettings s;
    for (Extent2D e : {Extent2D{1280, 720}, Extent2D{641, 359}, Extent2D{100, 100}})
        for (int levels = 1; levels <= 8; ++levels)
            for (auto [start, divisor] : {std::pair{StartResolution::full, 1},
                                          {StartResolution::half, 2},
                                          {StartResolution::quarter, 4}}) {
                s.resolution = e;
                s.levels = levels;
                s.start = start;
                const double w = (e.width + divisor - 1) / divisor, h = (e.height + divisor - 1) / divisor;
                const double reach = std::ldexp(1.0, levels - 1), radius = coveringRingRadius(s);
                if (radius < 1024.0) CHECK(radius * reach >= std::sqrt(w * w + h * h) * (1.0 - 1e-6));
                if (radius > 1.0) CHECK((radius - 1.0) * reach < std::sqrt(w * w + h * h));
                s.ringRadius = float(radius);
                CHECK((radius >= 1.0 && radius <= 1024.0));
            }
    for (int levels : {std::numeric_limits<int>::min(), -1, 0, 9, 64, std::numeric_limits<int>::max()})
        for (Extent2D e : {Extent2D{1280, 720}, Extent2D{-4, 0}}) {
            s.levels = levels;
            s.resolution = e;
            const float radius = coveringRingRadius(s);
            CHECK((radius >= 1.0f && radius <= 1024.0f));
        }
}

TEST_CASE("a frame is refused where its camera contradicts the settings' conventions") {
    ScreenIndirectSettings s;
    s.resolution = {64, 64};
    ScreenIndirectFrame<int> frame;
    frame.camera.projection = glm::mat4(0.0f);
    const auto inputs = screenIndirectInputs(s, frame);
    REQUIRE_FALSE(inputs);
    CHECK(inputs.error().message.find("camera.projection") == 0);
}

} // namespace rebound
