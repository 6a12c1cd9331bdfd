// SPDX-License-Identifier: MIT
// How kernels read images, in every instruction set, at widths around those of the lanes.
#include "kernel_runner.hpp"

namespace rebound::test {
namespace {

constexpr int widths[] = {1, 2, 3, 15, 16, 17, 31, 33, 40, 100};
constexpr int heights[] = {1, 2, 3, 5};

// Reads a texture that lies where another image has left numbers, so that what surrounds it is seen to be
// zero.
struct AccessCase {
    int mode = 0;
    Extent2D source, grid;
    ivec2 offset{0};
    int shift = 0, bias = 0;
};

Plan accessPlan(const AccessCase& c) {
    const Extent2D large{c.source.width + 37, c.source.height + 3};
    const AccessConstants k{{c.grid.width, c.grid.height, c.shift, c.bias}, {c.offset.x, c.offset.y, 0, 0}};
    Plan plan{"test", {}, {}};
    const auto host = plan.add({"host", ResourceKind::input, {}, 4, c.source, {}, 0});
    const auto dirt = plan.add({"dirt", ResourceKind::input, {}, 4, large, {}, 0});
    const auto left = plan.add({"left", ResourceKind::transient, {}, 4, large, {}, 0});
    const auto source = plan.add({"source", ResourceKind::transient, {}, 4, c.source, {}, 0});
    const auto result = plan.add({"result", ResourceKind::output, {}, 4, c.grid, {}, 0});
    const auto constants = plan.add(bufferResource("constants", std::vector{k}));
    plan.passes.push_back(
        {"leave numbers", "copy", {}, {{0, dirt}, {1, left, Access::write}, {2, constants}}, large});
    plan.passes.push_back(
        {"copy", "copy", {}, {{0, host}, {1, source, Access::write}, {2, constants}}, c.source});
    if (c.mode == accessFetch) {
        plan.passes.push_back(
            {"fetch", "fetch", {}, {{0, source}, {1, result, Access::write}, {2, constants}}, c.grid});
        return plan;
    }
    plan.passes.push_back({"access",
                           "access",
                           {c.mode},
                           {{0, source}, {1, host}, {2, result, Access::write}, {3, constants}},
                           c.grid});
    return plan;
}

Picture access(const cpu::Device& device, const AccessCase& c, Picture& source) {
    auto program = device.compile(accessPlan(c));
    REQUIRE(program);
    Picture dirt({c.source.width + 37, c.source.height + 3}, 4, 1e9f), result(c.grid, 4, -1.0f);
    REQUIRE(program->record(
        {{{"host", source.image()}, {"dirt", dirt.image()}, {"result", result.image()}}, {}}));
    return result;
}

// Checks every texel against the source's texel at texelAt(x, y).
template <class TexelAt>
void check(const AccessCase& c, TexelAt texelAt) {
    Picture source = numbered(c.source);
    for (cpu::Isa isa : cpu::availableIsas()) {
        const cpu::Device device = deviceFor(isa);
        const Picture result = access(device, c, source);
        int wrong = 0;
        for (int y = 0; y < c.grid.height; ++y)
            for (int x = 0; x < c.grid.width; ++x) {
                const ivec2 at = texelAt(x, y);
                for (int k = 0; k < 4; ++k) {
                    const float want = source.reach(at.x, at.y, k);
                    if (result.at(x, y, k) != want && ++wrong == 1)
                        FAIL_CHECK("mode " << c.mode << " in " << std::string(cpu::name(isa)) << ", source "
                                           << detail::toText(c.source) << ", grid " << detail::toText(c.grid)
                                           << ", offset " << c.offset.x << " " << c.offset.y << ", shift "
                                           << c.shift << ": texel " << x << " " << y << " " << k << " is "
                                           << result.at(x, y, k) << ", not " << want);
                }
            }
        CHECK(wrong == 0);
    }
}

} // namespace

TEST_CASE("fetch: this pixel's texel") {
    for (int width : widths)
        for (int height : heights)
            for (int mode : {accessFetch, accessHost})
                check({mode, {width, height}, {width, height}}, [](int x, int y) { return ivec2(x, y); });
}

TEST_CASE("fetchOffset: zero outside, however far") {
    for (int width : widths)
        for (ivec2 o : {ivec2(0, 0), ivec2(1, 0), ivec2(-1, 1), ivec2(7, -1), ivec2(-15, 0), ivec2(16, 2),
                        ivec2(-17, -2), ivec2(99, 0), ivec2(-99, 4), ivec2(0, 1000000), ivec2(1000000, 0),
                        ivec2(-1000000, -1000000), ivec2(1 << 30, 0), ivec2(-(1 << 30), 1)})
            for (int mode : {accessOffset, accessHostOffset})
                check({mode, {width, 5}, {width, 5}, o}, [o](int x, int y) { return ivec2(x, y) + o; });
}

TEST_CASE("reaches: true wherever a texel lies inside") {
    Picture source = numbered({40, 5});
    for (ivec2 o :
         {ivec2(0, 0), ivec2(39, 4), ivec2(-39, -4), ivec2(40, 0), ivec2(0, -5), ivec2(-1000000, 0)})
        for (cpu::Isa isa : cpu::availableIsas()) {
            const Picture result = access(deviceFor(isa), {accessReaches, {40, 5}, {40, 5}, o}, source);
            bool some = false;
            for (int y = 0; y < 5; ++y)
                for (int x = 0; x < 40; ++x) {
                    const bool inside = source.reach(x + o.x, y + o.y, 0) != 0.0f;
                    if (inside || isa == cpu::Isa::scalar)
                        CHECK(result.at(x, y, 0) == (inside ? 1.0f : 0.0f));
                    some = some || result.at(x, y, 0) != 0.0f;
                }
            // A whole image away, lanes of any number reach nothing.
            if (o.x == -1000000 || o.x == 40 || o.y == -5) CHECK_FALSE(some);
        }
}

TEST_CASE("fetchMinified: every other texel, at offsets of -2 to 3") {
    for (int width : widths)
        for (int o = -2; o <= 3; ++o)
            for (int mode : {accessMinified, accessHostMinified}) {
                const ivec2 offset(o, 1 - o);
                auto at = [offset](int x, int y) { return ivec2(2 * x, 2 * y) + offset; };
                check({mode, {width, 5}, {(width + 1) / 2, 3}, offset}, at);
                // A grid wider than half the source runs off its side.
                check({mode, {width, 5}, {width, 3}, offset}, at);
            }
}

TEST_CASE("fetchMagnified: texels repeated 2^shift times, shifted by a bias, at offsets of -1 to 1") {
    for (int width : widths)
        for (int shift = 0; shift <= 3; ++shift)
            for (int o = -1; o <= 1; ++o)
                for (int bias : {0, shift == 0 ? 0 : 1 << (shift - 1), 1 << shift}) {
                    const Extent2D grid{width, 5};
                    const Extent2D source{(width + (1 << shift) - 1) >> shift,
                                          (5 + (1 << shift) - 1) >> shift};
                    const ivec2 offset(o, -o);
                    check({accessMagnified, source, grid, offset, shift, bias}, [=](int x, int y) {
                        return ivec2((x + bias) >> shift, (y + bias) >> shift) + offset;
                    });
                }
}

TEST_CASE("fetchAt: any texel, zero outside") {
    for (int width : widths)
        for (ivec2 o : {ivec2(0, 0), ivec2(-5, -1), ivec2(1000000, 0), ivec2(0, -1000000)})
            check({accessAt, {width, 5}, {width, 5}, o},
                  [o](int x, int y) { return ivec2(3 * x, 2 * y) + o; });
}

TEST_CASE("pixelCenter: half a pixel behind the pixel's number") {
    Picture source = numbered({33, 3});
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture result = access(deviceFor(isa), {accessCenter, {33, 3}, {33, 3}}, source);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 33; ++x) {
                CHECK(result.at(x, y, 0) == float(x) + 0.5f);
                CHECK(result.at(x, y, 1) == float(y) + 0.5f);
            }
    }
}

TEST_CASE("sparse pixels: every pixel once, its lanes in columns of its parity, at all widths") {
    for (int width : widths)
        for (int height : {1, 3})
            for (int mode = 0; mode < sparseModeCount; ++mode)
                for (ivec2 o : {ivec2(0, 0), ivec2(1, 0), ivec2(-1, 1), ivec2(-37, 0), ivec2(38, -1),
                                ivec2(200, 0), ivec2(-200, 2)}) {
                    if (o != ivec2(0, 0) && mode != sparseOffset && mode != sparseReaches) continue;
                    const Extent2D extent{width, height};
                    const AccessConstants k{{width, height, 0, 0}, {o.x, o.y, 0, 0}};
                    Plan plan{"test", {}, {}};
                    const auto host = plan.add({"host", ResourceKind::input, {}, 4, extent, {}, 0});
                    const auto source = plan.add({"source", ResourceKind::transient, {}, 4, extent, {}, 0});
                    const auto result = plan.add({"result", ResourceKind::transient, {}, 4, extent, {}, 0});
                    const auto constants = plan.add(bufferResource("constants", std::vector{k}));
                    plan.passes.push_back({"copy",
                                           "copy",
                                           {},
                                           {{0, host}, {1, source, Access::write}, {2, constants}},
                                           extent});
                    plan.passes.push_back({"sparse",
                                           "sparse",
                                           {mode},
                                           {{0, source}, {1, result, Access::write}, {2, constants}},
                                           extent});
                    Picture picture = numbered(extent);
                    for (cpu::Isa isa : cpu::availableIsas()) {
                        auto program = deviceFor(isa).compile(plan);
                        REQUIRE(program);
                        REQUIRE(program->record({{{"host", picture.image()}}, {}}));
                        const std::vector<float> texels = floatsOf(*program->read("result"));
                        int wrong = 0;
                        for (int y = 0; y < height; ++y)
                            for (int x = 0; x < width; ++x)
                                for (int c = 0; c < 4; ++c) {
                                    const float place[] = {float(x) + 0.5f, float(y) + 0.5f, float(x & 1),
                                                           float(y)};
                                    const float want =
                                        mode == sparsePlace ? place[c] : picture.reach(x + o.x, y + o.y, c);
                                    wrong += texels[picture.index(x, y, c)] != want;
                                }
                        CAPTURE(std::string(cpu::name(isa)));
                        CAPTURE(width);
                        CAPTURE(mode);
                        CAPTURE(o.x);
                        CHECK(wrong == 0);
                    }
                }
}

} // namespace rebound::test
