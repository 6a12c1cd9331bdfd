// SPDX-License-Identifier: MIT
// Images of the host in every layout: planar or interleaved, float or half, packed or strided, upside down.
#include "half_operands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rebound::test {
namespace {

constexpr int widths[] = {1, 2, 3, 15, 16, 17, 31, 33, 40, 100};

struct Layout {
    std::string name;
    bool planar, half;
    int spare = 0;         // pixels between rows that belong to none
    bool flipped = false;  // rows from the bottom up
    int spareChannels = 0; // between pixels
};

const Layout layouts[] = {
    {"interleaved floats", false, false},
    {"planar floats", true, false},
    {"interleaved halves", false, true},
    {"planar halves", true, true},
    {"planar floats, spare columns", true, false, 5},
    {"planar halves, spare columns, flipped", true, true, 3, true},
    {"interleaved floats, spare channels and columns, flipped", false, false, 2, true, 3},
    {"interleaved halves, spare channels", false, true, 0, false, 1},
};

// The exact value of a half.
float halfValue(uint16_t h) {
    const int exponent = h >> 10 & 31, mantissa = h & 1023;
    const float sign = h & 0x8000 ? -1.0f : 1.0f;
    if (exponent == 31) return mantissa ? std::numeric_limits<float>::quiet_NaN() : sign * INFINITY;
    return sign *
           (exponent ? std::ldexp(float(1024 + mantissa), exponent - 25) : std::ldexp(float(mantissa), -24));
}

// Memory of an image, guarded by a pattern that no kernel writes.
struct HostMemory {
    static constexpr std::byte guard{0xa5};
    std::vector<std::byte> bytes;
    cpu::Image image;

    HostMemory(const Layout& l, Extent2D extent, int channels) {
        const ptrdiff_t size = l.half ? 2 : 4;
        image.extent = extent;
        image.channels = channels;
        image.scalar = l.half ? cpu::Scalar::float16 : cpu::Scalar::float32;
        image.pixelStride = l.planar ? size : size * (channels + l.spareChannels);
        const ptrdiff_t row = image.pixelStride * (extent.width + l.spare);
        image.channelStride = l.planar ? row * extent.height : size;
        image.rowStride = l.flipped ? -row : row;
        bytes.assign(size_t(row * extent.height * (l.planar ? channels : 1)) + 128, guard);
        image.data = bytes.data() + 64 + (l.flipped ? row * (extent.height - 1) : 0);
    }
    std::byte* at(int x, int y, int c) {
        return static_cast<std::byte*>(image.data) + x * image.pixelStride + y * image.rowStride +
               c * image.channelStride;
    }
    float read(int x, int y, int c) {
        if (image.scalar == cpu::Scalar::float32) {
            float f;
            std::memcpy(&f, at(x, y, c), 4);
            return f;
        }
        uint16_t h;
        std::memcpy(&h, at(x, y, c), 2);
        return halfValue(h);
    }
    // The half of index h, or its value.
    void writeHalf(int x, int y, int c, uint16_t h) {
        const float f = halfValue(h);
        if (image.scalar == cpu::Scalar::float32) std::memcpy(at(x, y, c), &f, 4);
        else std::memcpy(at(x, y, c), &h, 2);
    }
    // Bytes that no texel covers keep the guard's pattern.
    bool guarded() {
        std::vector<std::byte> rest = bytes;
        const size_t size = image.scalar == cpu::Scalar::float32 ? 4 : 2;
        for (int y = 0; y < image.extent.height; ++y)
            for (int x = 0; x < image.extent.width; ++x)
                for (int c = 0; c < image.channels; ++c)
                    std::memset(rest.data() + (at(x, y, c) - bytes.data()), int(guard), size);
        for (std::byte b : rest)
            if (b != guard) return false;
        return true;
    }
};

// Half floats that are finite, ever another.
uint16_t someHalf(int x, int y, int c) { return uint16_t((x * 4099 + y * 517 + c * 12289 + 1) % 0x7c00); }

// Copies the host's image to another one by way of a kernel.
void copyThrough(const cpu::Device& device, HostMemory& from, HostMemory& to) {
    const Extent2D extent = from.image.extent;
    const AccessConstants k{{extent.width, extent.height, 0, 0}, {0, 0, 0, 0}};
    Plan plan{"test", {}, {}};
    const auto host = plan.add({"host", ResourceKind::input, {}, from.image.channels, extent, {}, 0});
    const auto source = plan.add({"source", ResourceKind::transient, {}, 4, extent, {}, 0});
    const auto result = plan.add({"result", ResourceKind::output, {}, to.image.channels, extent, {}, 0});
    const auto constants = plan.add(bufferResource("constants", std::vector{k}));
    plan.passes.push_back(
        {"copy", "copy", {}, {{0, host}, {1, source, Access::write}, {2, constants}}, extent});
    plan.passes.push_back({"access",
                           "access",
                           {accessFetch},
                           {{0, source}, {1, host}, {2, result, Access::write}, {3, constants}},
                           extent});
    auto program = device.compile(plan);
    REQUIRE(program);
    REQUIRE(program->record({{{"host", from.image}, {"result", to.image}}, {}}));
}

void checkCopy(cpu::Isa isa, const Layout& from, const Layout& to, Extent2D extent, int channelsIn,
               int channelsOut) {
    HostMemory source(from, extent, channelsIn), result(to, extent, channelsOut);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x)
            for (int c = 0; c < channelsIn; ++c) source.writeHalf(x, y, c, someHalf(x, y, c));
    copyThrough(deviceFor(isa), source, result);
    bool same = true;
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x)
            for (int c = 0; c < channelsOut; ++c)
                same = same && result.read(x, y, c) == (c < channelsIn ? halfValue(someHalf(x, y, c)) : 0.0f);
    INFO(std::string(cpu::name(isa)), ": ", from.name, " to ", to.name, ", ", extent.width, "x",
         extent.height);
    CHECK(same);
    CHECK(result.guarded());
    CHECK(source.guarded());
}

} // namespace

TEST_CASE("host images: read and written in every layout, at every width, and nothing beside them touched") {
    for (cpu::Isa isa : cpu::availableIsas())
        for (int width : widths)
            for (size_t i = 0; i < std::size(layouts); ++i) {
                checkCopy(isa, layouts[i], layouts[0], {width, 3}, 4, 4);
                checkCopy(isa, layouts[0], layouts[i], {width, 2}, 4, 4);
                checkCopy(isa, layouts[i], layouts[(i + 3) % std::size(layouts)], {width, 1}, 3, 3);
            }
}

TEST_CASE("host images: absent channels read as zero, and writes to them are dropped") {
    for (cpu::Isa isa : cpu::availableIsas())
        for (const Layout& layout : layouts)
            for (int in = 1; in <= 4; ++in)
                for (int out = 1; out <= 4; ++out) checkCopy(isa, layout, layout, {19, 2}, in, out);
}

TEST_CASE("host images: halves are rounded to the nearest, halfway to even") {
    // Every finite half, halfway to its successor, and next to halfway on either side.
    const Extent2D extent{1024, 31};
    const Layout floats{"floats", true, false}, halves{"halves", true, true};
    for (cpu::Isa isa : cpu::availableIsas()) {
        HostMemory source(floats, extent, 4), result(halves, extent, 4);
        for (int i = 0; i < 1024 * 31; ++i) {
            const float low = halfValue(uint16_t(i)),
                        high = i + 1 == 0x7c00 ? 65536.0f : halfValue(uint16_t(i + 1));
            const float middle = 0.5f * (low + high);
            const float values[4] = {-low, middle, std::nextafter(middle, 0.0f),
                                     std::nextafter(middle, 1e6f)};
            for (int c = 0; c < 4; ++c) std::memcpy(source.at(i % 1024, i / 1024, c), &values[c], 4);
        }
        copyThrough(deviceFor(isa), source, result);
        int wrong = 0;
        for (int i = 0; i < 1024 * 31; ++i) {
            const float low = halfValue(uint16_t(i)), high = std::min(halfValue(uint16_t(i + 1)), 65504.0f);
            const float want[4] = {-low, i % 2 == 0 ? low : high, low, high};
            for (int c = 0; c < 4; ++c) wrong += result.read(i % 1024, i / 1024, c) == want[c] ? 0 : 1;
        }
        INFO(std::string(cpu::name(isa)));
        CHECK(wrong == 0);
    }
}

TEST_CASE("images of halves end at 65504, and the host's hold the nearest one") {
    Picture source = numbersAroundHalves();
    for (cpu::Isa isa : cpu::availableIsas()) {
        CAPTURE(std::string(cpu::name(isa)));
        auto program = deviceFor(isa).compile(halvesPlan(source.extent));
        REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
        Picture result(source.extent, 4);
        REQUIRE(program->record({{{"host", source.image()}, {"result", result.image()}}, {}}));
        int wrong = 0; // the device keeps floats
        for (size_t i = 0; i < source.values.size(); ++i) {
            const float value = source.values[i], want = std::clamp(value, -65504.0f, 65504.0f);
            wrong += std::isnan(value) ? !std::isnan(result.values[i]) : result.values[i] != want;
        }
        CHECK(wrong == 0);

        const Layout floats{"floats", false, false};
        HostMemory from(floats, source.extent, 4);
        std::memcpy(from.at(0, 0, 0), source.values.data(), source.values.size() * sizeof(float));
        for (bool planar : {false, true}) { // by single values, and by vectors of them
            HostMemory half({"halves", planar, true}, source.extent, 4);
            copyThrough(deviceFor(isa), from, half);
            for (int y = 0; y < source.extent.height; ++y)
                for (int x = 0; x < source.extent.width; ++x)
                    for (int c = 0; c < 4; ++c) result.at(x, y, c) = half.read(x, y, c);
            checkNearestHalves(source, result);
        }
    }
}

TEST_CASE("host images: halves that are no numbers, infinite, or too large") {
    // What kernels store ends at 65504; what a host has stored arrives as it is.
    const float values[] = {INFINITY, -INFINITY, NAN, 1e30f, -65520.0f, 65519.0f, 1e-30f, -0.0f};
    const Layout floats{"floats", true, false}, halves{"halves", false, true};
    for (cpu::Isa isa : cpu::availableIsas()) {
        HostMemory source(floats, {33, 1}, 1), half(halves, {33, 1}, 1), result(floats, {33, 1}, 1);
        for (int x = 0; x < 33; ++x) std::memcpy(source.at(x, 0, 0), &values[x % 8], 4);
        copyThrough(deviceFor(isa), source, half);
        copyThrough(deviceFor(isa), half, result);
        for (int x = 0; x < 33; ++x) {
            const float want[] = {65504.0f, -65504.0f, NAN, 65504.0f, -65504.0f, 65504.0f, 0.0f, -0.0f};
            CAPTURE(x % 8);
            if (x % 8 == 2) CHECK(std::isnan(result.read(x, 0, 0)));
            else CHECK(result.read(x, 0, 0) == want[x % 8]);
        }
        for (int x = 0; x < 33; ++x) half.writeHalf(x, 0, 0, x % 2 == 0 ? 0x7c00 : 0xfc00);
        copyThrough(deviceFor(isa), half, result);
        for (int x = 0; x < 33; ++x) CHECK(result.read(x, 0, 0) == (x % 2 == 0 ? INFINITY : -INFINITY));
    }
}

} // namespace rebound::test
