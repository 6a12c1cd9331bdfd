// SPDX-License-Identifier: MIT
// How kernels read images, in every instruction set, at widths around those of the lanes.
#include "kernel_runner.hpp"

#include <glm/gtc/packing.hpp>

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
    bool isApart =
        false; // whether a kernel reads the texture by sparse pixels, so that its columns are kept apart
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
    if (c.isApart) {
        const AccessConstants all{{c.source.width, c.source.height, 0, 0}, {0, 0, 0, 0}};
        const auto other = plan.add({"other", ResourceKind::transient, {}, 4, c.source, {}, 0});
        const auto otherConstants = plan.add(bufferResource("other constants", std::vector{all}));
        plan.passes.push_back({"sparse",
                               "sparse",
                               {sparseFetch},
                               {{0, source}, {1, other, Access::write}, {2, otherConstants}},
                               c.source});
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
void checkLayout(const AccessCase& c, TexelAt texelAt) {
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

// Of a texture whose columns lie in order, and of one whose even and odd columns are kept apart.
template <class TexelAt>
void check(AccessCase c, TexelAt texelAt) {
    checkLayout(c, texelAt);
    c.isApart = true;
    if (c.mode < accessHost && c.mode != accessFetch) checkLayout(c, texelAt);
}

// An image of the host in each layout that has an access of its own: whether texels lie side by side or pixels do, in
// floats or in halves.
void checkHostLayouts(int mode, Extent2D extent, Extent2D grid, ivec2 offset, int step) {
    const AccessConstants k{{grid.width, grid.height, 0, 0}, {offset.x, offset.y, 0, 0}};
    Plan plan{"test", {}, {}};
    const auto host = plan.add({"host", ResourceKind::input, {}, 4, extent, {}, 0});
    const auto source = plan.add({"source", ResourceKind::transient, {}, 4, extent, {}, 0});
    const auto result = plan.add({"result", ResourceKind::output, {}, 4, grid, {}, 0});
    const auto constants = plan.add(bufferResource("constants", std::vector{k}));
    plan.passes.push_back(
        {"copy", "copy", {}, {{0, host}, {1, source, Access::write}, {2, constants}}, extent});
    plan.passes.push_back({"access",
                           "access",
                           {mode},
                           {{0, source}, {1, host}, {2, result, Access::write}, {3, constants}},
                           grid});
    std::vector<float> floats(size_t(extent.width) * size_t(extent.height) * 4);
    std::vector<uint16_t> halves(floats.size());
    for (bool isPlanar : {true, false})
        for (bool isHalf : {true, false}) {
            cpu::Image image = isPlanar ? cpu::planarImage(floats.data(), extent, 4)
                                        : cpu::interleavedImage(floats.data(), extent, 4);
            if (isHalf)
                image = isPlanar ? cpu::planarImage(halves.data(), extent, 4, cpu::Scalar::float16)
                                 : cpu::interleavedImage(halves.data(), extent, 4, cpu::Scalar::float16);
            const ptrdiff_t size = isHalf ? 2 : 4;
            // Whole numbers below 2048, which halves hold.
            const auto number = [](int x, int y, int c) {
                return float((x * 13 + y * 101 + c * 509) % 2039 + 1);
            };
            for (int y = 0; y < extent.height; ++y)
                for (int x = 0; x < extent.width; ++x)
                    for (int c = 0; c < 4; ++c) {
                        const ptrdiff_t at =
                            (x * image.pixelStride + y * image.rowStride + c * image.channelStride) / size;
                        floats[size_t(at)] = number(x, y, c);
                        halves[size_t(at)] = glm::packHalf1x16(number(x, y, c));
                    }
            for (cpu::Isa isa : cpu::availableIsas()) {
                auto program = deviceFor(isa).compile(plan);
                REQUIRE(program);
                Picture read(grid, 4, -1.0f);
                REQUIRE(program->record({{{"host", image}, {"result", read.image()}}, {}}));
                int wrong = 0;
                for (int y = 0; y < grid.height; ++y)
                    for (int x = 0; x < grid.width; ++x)
                        for (int c = 0; c < 4; ++c) {
                            const ivec2 at = ivec2(step * x, step * y) + offset;
                            const bool isInside =
                                at.x >= 0 && at.y >= 0 && at.x < extent.width && at.y < extent.height;
                            wrong += read.at(x, y, c) != (isInside ? number(at.x, at.y, c) : 0.0f);
                        }
                CAPTURE(std::string(cpu::name(isa)));
                CAPTURE(isPlanar);
                CAPTURE(isHalf);
                CAPTURE(extent.width);
                CAPTURE(offset.x);
                CHECK(wrong == 0);
            }
        }
}

} // namespace

TEST_CASE("images of the host: the same in every layout, at every step") {
    for (int width : {1, 3, 17, 31, 64, 65, 100, 130})
        for (int o = 0; o <= 3; ++o) {
            const ivec2 offset(o, o / 2);
            checkHostLayouts(accessHostOffset, {width, 5}, {width, 5}, offset, 1);
            checkHostLayouts(accessHostMinified, {width, 5}, {(width + 1) / 2, 3}, offset, 2);
            checkHostLayouts(accessHostQuarter, {width, 5}, {(width + 3) / 4, 2}, offset, 4);
        }
}

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
            for (int mode : {accessAt, accessHostAt})
                check({mode, {width, 5}, {width, 5}, o},
                      [o](int x, int y) { return ivec2(3 * x, 3 * y) + o; });
}

TEST_CASE("fetchAt: any texel of an image of the host, in each layout") {
    for (Extent2D e : {Extent2D{1, 1}, Extent2D{16, 3}, Extent2D{37, 5}})
        checkHostLayouts(accessHostAt, e, e, ivec2(-4, -1), 3);
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
                    // Which has the first result kept with its columns apart, too.
                    if (height == 3) {
                        const auto again = plan.add({"again", ResourceKind::transient, {}, 4, extent, {}, 0});
                        plan.passes.push_back({"again",
                                               "sparse",
                                               {sparseFetch},
                                               {{0, result}, {1, again, Access::write}, {2, constants}},
                                               extent});
                    }
                    Picture picture = numbered(extent);
                    for (cpu::Isa isa : cpu::availableIsas()) {
                        auto program = deviceFor(isa).compile(plan);
                        REQUIRE(program);
                        REQUIRE(program->record({{{"host", picture.image()}}, {}}));
                        const std::vector<float> texels =
                            floatsOf(*program->read(height == 3 ? "again" : "result"));
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
