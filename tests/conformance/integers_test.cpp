// SPDX-License-Identifier: MIT
// Unsigned integers, and buffers of numbers, on every backend of this machine against plain C++.
#include "each_backend.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace rebound::test {
namespace {

namespace k {
// In this order, which blank lines keep.
#include "rebound/math/uniform_types.h"

#include "kernels/test_constants.h"
} // namespace k

constexpr Extent2D extent{19, 6};

using Numbers = std::vector<uint32_t>;

// Edges of the range, and values without a pattern.
Numbers operands(uint32_t seed) {
    Numbers values{0u,          1u,          2u,          0x7fffffffu, 0x80000000u, 0x80000001u,
                   0xffffffffu, 0xfffffffeu, 0x00800000u, 0x01000001u, 0x7fa00000u, 0xff800000u,
                   31u,         65535u,      65536u,      0xaaaaaaaau};
    for (uint32_t i = 0; values.size() < size_t(extent.width) * size_t(extent.height) * 4; ++i) {
        seed = seed * 1664525u + 1013904223u + i;
        values.push_back(seed ^ (seed >> 13));
    }
    return values;
}

lab::Image imageOf(const Numbers& values) {
    lab::Image image(extent, 4);
    std::memcpy(image.data.data(), values.data(), values.size() * sizeof(uint32_t));
    return image;
}

Numbers numbersOf(const std::vector<float>& floats) {
    Numbers values(floats.size());
    std::memcpy(values.data(), floats.data(), values.size() * sizeof(uint32_t));
    return values;
}

Plan integersPlan(int operation) {
    Plan plan{"integers", {}, {}};
    const auto add = [&](const char* name, ResourceKind kind) {
        return plan.add({name, kind, Format::rgba32ui, 4, extent, {}, 0});
    };
    const auto first = add("first", ResourceKind::input), second = add("second", ResourceKind::input),
               copy = add("copy", ResourceKind::transient), result = add("result", ResourceKind::output);
    const auto constants = plan.add(
        bufferResource("constants", std::vector<k::GridConstants>{{{extent.width, extent.height, 0, 0}}}));
    plan.passes = {
        {"copy", "copy_integers", {}, {{0, second}, {1, copy, Access::write}, {2, constants}}, extent},
        {"integers",
         "integers",
         {operation},
         {{0, first}, {1, copy}, {2, result, Access::write}, {3, constants}},
         extent}};
    return plan;
}

// first's .y of the left neighbour, and second's .z of the lower one; 0 outside.
uint32_t neighbours(const Numbers& first, const Numbers& second, size_t pixel) {
    const size_t width = size_t(extent.width), x = pixel % width, y = pixel / width;
    const uint32_t left = x > 0 ? first[4 * (pixel - 1) + 1] : 0;
    const uint32_t below = y + 1 < size_t(extent.height) ? second[4 * (pixel + width) + 2] : 0;
    return left ^ below;
}

uint32_t expected(int operation, uint32_t x, uint32_t y) {
    switch (operation) {
    case k::uintAdd:
        return x + y;
    case k::uintSubtract:
        return x - y;
    case k::uintMultiply:
        return x * y;
    case k::uintAnd:
        return x & y;
    case k::uintOr:
        return x | y;
    case k::uintXor:
        return x ^ y;
    case k::uintNot:
        return ~x;
    case k::uintShiftRight:
        return x >> 5;
    case k::uintShiftLeft:
        return x << 5;
    case k::uintLess:
        return x < y;
    case k::uintGreater:
        return x > y;
    case k::uintEqual:
        return x == y;
    case k::uintSelect:
        return std::min(x, y);
    case k::uintToReal:
        return std::bit_cast<uint32_t>(float(x));
    case k::uintFromReal:
        return uint32_t(float(x >> 1));
    case k::uintFloatBits:
        return x & 0x7f7fffffu;
    case k::uintBitCount:
        return uint32_t(std::popcount(x));
    case k::uintToInt:
        return x - 1u;
    case k::uintFromInt:
        return uint32_t(int32_t(x) >> 3);
    case k::uintAddTo:
        return (x + y) ^ 1u;
    default:
        FAIL("an operation without an expected value");
        return 0;
    }
}

// What item i adds to the results of the kernel numbers.
void expect(int way, int i, int offset, const Numbers& source, const std::vector<float>& reals,
            Numbers& right, std::vector<float>& realRight) {
    const int size = int(source.size());
    const auto isInside = [&](int at, int width = 1) { return at >= 0 && at < size / width; };
    const int read = way == k::reachOffset    ? i + offset
                     : way == k::reachAt      ? 3 * i + offset
                     : way == k::reachUniform ? offset
                     : way == k::reachFirst   ? (i * 5) & 3
                                              : i;
    const int written = way == k::reachStoreOffset ? i + offset : way == k::reachStoreAt ? 3 * i + offset : i;
    if (way == k::reachStoreFour) {
        right[size_t(i)] = source[size_t(i)];
        if (isInside(i + offset, 4))
            for (int c = 0; c < 4; ++c) realRight[size_t(4 * (i + offset) + c)] = reals[size_t(i)] + float(c);
        return;
    }
    if (!isInside(written)) return;
    right[size_t(written)] = isInside(read) ? source[size_t(read)] : 0u;
    float& real = realRight[size_t(written)];
    real = isInside(read) ? reals[size_t(way == k::reachFirst ? read + 1 : read)] : 0.0f;
    if (way != k::reachFour) return;
    real = 0.0f;
    if (isInside(i + offset, 4))
        for (int c = 0; c < 4; ++c) real += float(1 << c) * reals[size_t(4 * (i + offset) + c)];
}

// GPUs round integers of more than 24 bits to one of the two nearest floats, as OpenGL and Vulkan allow.
bool agrees(int operation, uint32_t value, uint32_t right) {
    if (operation != k::uintToReal && operation != k::uintFromReal) return value == right;
    if (operation == k::uintToReal) return std::abs(int64_t(value) - int64_t(right)) <= 1;
    return std::abs(double(value) - double(right)) <= std::ldexp(double(right), -23);
}

} // namespace

TEST_CASE("operations on unsigned integers, and images that hold them") {
    const Numbers first = operands(1), second = operands(77);
    runner::PlanInputs inputs;
    inputs.images = {{"first", imageOf(first)}, {"second", imageOf(second)}, {"result", {}}};
    onEachBackend([&](runner::Backend& backend) {
        for (int operation = 0; operation < k::uintOpCount; ++operation) {
            CAPTURE(operation);
            auto plan = prepare(backend, integersPlan(operation), inputs);
            REQUIRE(plan->run());
            const Numbers result = numbersOf(read(*plan, "result"));
            REQUIRE(result.size() == first.size());
            size_t wrong = 0;
            for (size_t i = 0; i < result.size() / 4; ++i) {
                const uint32_t x = first[4 * i], y = second[4 * i];
                const uint32_t right =
                    operation == k::uintOffset ? neighbours(first, second, i) : expected(operation, x, y);
                const bool isRight = agrees(operation, result[4 * i], right) &&
                                     result[4 * i + 1] == second[4 * i + 1] &&
                                     result[4 * i + 2] == first[4 * i + 2] && result[4 * i + 3] == x;
                if (!isRight && wrong++ == 0) {
                    CAPTURE(x);
                    CAPTURE(y);
                    CHECK(result[4 * i] == right);
                }
            }
            CHECK(wrong == 0);
        }
    });
}

TEST_CASE("items read and write buffers of numbers, and nothing beyond them") {
    constexpr int count = 75, size = 90; // no multiple of lanes, groups or fours; more elements than items
    Numbers source(size);
    std::vector<float> reals(size);
    for (size_t i = 0; i < size_t(size); ++i) {
        source[i] = uint32_t(1000 + i);
        reals[i] = 0.5f * float(i) - 7.0f;
    }
    for (int offset : {0, 3, -4, 40})
        for (int way = 0; way < k::reachCount; ++way) {
            if (way == k::reachUniform && offset < 0)
                continue; // lies outside, which uniform indices must not
            CAPTURE(way);
            CAPTURE(offset);
            Plan plan{"numbers", {}, {}};
            const auto add = [&](const char* name, ResourceKind kind, Format format) {
                return plan.add({name, kind, format, 1, {}, {}, size_t(size) * 4});
            };
            const auto from = add("source", ResourceKind::inputBuffer, Format::r32ui),
                       realFrom = add("reals", ResourceKind::inputBuffer, Format::r32f),
                       to = add("result", ResourceKind::outputBuffer, Format::r32ui),
                       realTo = add("real result", ResourceKind::outputBuffer, Format::r32f);
            const auto constants =
                plan.add(bufferResource("constants", std::vector<k::ItemConstants>{{{count, offset, 0, 0}}}));
            plan.passes = {{"numbers",
                            "numbers",
                            {way},
                            {{0, from},
                             {1, realFrom},
                             {2, to, Access::write},
                             {3, realTo, Access::write},
                             {4, constants}},
                            {},
                            count}};
            Numbers right(size, 0u);
            std::vector<float> realRight(size, 0.0f);
            for (int i = 0; i < count; ++i) expect(way, i, offset, source, reals, right, realRight);
            runner::PlanInputs inputs;
            inputs.buffers = {{"source", sharedBytes(source)},
                              {"reals", sharedBytes(reals)},
                              {"result", {}},
                              {"real result", {}}};
            onEachBackend([&](runner::Backend& backend) {
                auto prepared = prepare(backend, plan, inputs);
                REQUIRE(prepared->run());
                CHECK(numbersOf(read(*prepared, "result")) == right);
                CHECK(read(*prepared, "real result") == realRight);
            });
        }
}

TEST_CASE("more items than one row of groups holds") {
    // 65535 groups of 64 are a row; the next items begin another one.
    constexpr int count = 65535 * 64 + 100;
    Plan plan{"many", {}, {}};
    const auto add = [&](const char* name, ResourceKind kind) {
        return plan.add({name, kind, Format::r32f, 1, {}, {}, size_t(count) * 4});
    };
    const auto after = add("after", ResourceKind::inputBuffer),
               before = add("before", ResourceKind::transientBuffer),
               report = add("report", ResourceKind::outputBuffer);
    const auto constants =
        plan.add(bufferResource("constants", std::vector<k::SumConstants>{{{1, 1, count, 0}, {0, 0, 0, 0}}}));
    plan.passes = {{"keep",
                    "sum_keep",
                    {1, 1},
                    {{0, after}, {1, before, Access::write}, {2, report, Access::write}, {3, constants}},
                    {},
                    count}};
    std::vector<float> values(static_cast<size_t>(count));
    for (size_t i = 0; i < values.size(); ++i) values[i] = float(i);
    runner::PlanInputs inputs;
    inputs.buffers = {{"after", sharedBytes(values)}, {"report", {}}};
    onEachBackend([&](runner::Backend& backend) {
        auto prepared = prepare(backend, plan, inputs);
        REQUIRE(prepared->run());
        const auto doubled = read(*prepared, "report");
        size_t wrong = 0;
        for (size_t i = 0; i < values.size(); ++i) wrong += doubled[i] != 2.0f * values[i];
        CHECK(wrong == 0);
    });
}

} // namespace rebound::test
