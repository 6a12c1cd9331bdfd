// SPDX-License-Identifier: MIT
// Numbers on their way through an image of halves, on every backend.
#pragma once

#include "kernel_runner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rebound::test {

// The nearest half, halfway cases to the even one; beyond their range the largest; NaN stays.
inline float nearestHalf(float value) {
    if (std::isnan(value)) return value;
    const double magnitude = std::min(std::abs(double(value)), 65504.0);
    const int exponent = magnitude > 0.0 ? std::max(std::ilogb(magnitude), -14) : -14;
    const double unit = std::ldexp(1.0, exponent - 10); // between halves of that exponent
    return float(std::copysign(std::nearbyint(magnitude / unit) * unit, double(value)));
}

// Every half, what lies halfway between two and just beside it, and what lies beyond; 37 texels wide.
inline Picture numbersAroundHalves() {
    std::vector<float> values;
    for (int i = 0; i < 1024 * 31; i += i < 2048 ? 1 : 37) { // all denormal ones and the first normal ones
        const int exponent = std::max(i / 1024, 1);
        const double unit = std::ldexp(1.0, exponent - 25);
        const double half = unit * double(i % 1024 + (i / 1024 > 0 ? 1024 : 0));
        for (double part : {0.0, 0.25, 0.5, 0.75}) values.push_back(float(half + part * unit));
        const float middle = float(half + 0.5 * unit);
        values.push_back(-std::nextafter(middle, 0.0f));
        values.push_back(-std::nextafter(middle, 1e9f));
    }
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (float v : {65503.9f, 65504.0f, 65519.9f, 65520.0f, 65536.0f, 1e9f, 3e38f, infinity, 1e-30f, 0.0f})
        for (float sign : {1.0f, -1.0f}) values.push_back(sign * v);
    values.push_back(std::numeric_limits<float>::quiet_NaN());
    Picture picture({37, int(values.size() / (37 * 4)) + 1}, 4);
    std::copy(values.begin(), values.end(), picture.values.begin());
    return picture;
}

// host -> halves -> stored -> fetch -> result
inline Plan halvesPlan(Extent2D extent) {
    Plan plan{"test", {}, {}};
    const auto host = plan.add({"host", ResourceKind::input, Format::rgba32f, 4, extent, {}, 0});
    const auto stored = plan.add({"stored", ResourceKind::transient, Format::rgba16f, 4, extent, {}, 0});
    const auto result = plan.add({"result", ResourceKind::output, Format::rgba32f, 4, extent, {}, 0});
    const auto grid =
        plan.add(bufferResource("grid", std::vector<GridConstants>{{{extent.width, extent.height, 0, 0}}}));
    plan.passes.push_back(
        {"store", "halves", {}, {{0, host}, {1, stored, Access::write}, {2, grid}}, extent});
    plan.passes.push_back(
        {"fetch", "fetch", {}, {{0, stored}, {1, result, Access::write}, {2, grid}}, extent});
    return plan;
}

inline void checkNearestHalves(const Picture& source, const Picture& result) {
    REQUIRE(source.values.size() == result.values.size());
    int wrong = 0;
    for (size_t i = 0; i < source.values.size(); ++i) {
        const float want = nearestHalf(source.values[i]), got = result.values[i];
        const bool same = std::isnan(want) ? std::isnan(got) : got == want;
        if (!same && ++wrong == 1)
            FAIL_CHECK("value " << i << ", " << source.values[i] << ", is " << got << ", not " << want);
    }
    CHECK(wrong == 0);
}

} // namespace rebound::test
