// SPDX-License-Identifier: MIT
#include "lab/metrics/color_bar.hpp"
#include "lab/metrics/color_map.hpp"
#include "test_pictures.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace rebound::metrics {
namespace {

using doctest::Approx;
using Rgb = std::array<unsigned char, 3>;

const float nan = std::nanf("");

Rgb at(const lab::Picture& picture, int x, int y) {
    const size_t i = (size_t(y) * size_t(picture.width) + size_t(x)) * 3;
    return {picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]};
}

lab::Picture shown(const lab::Image& test, const lab::Image& truth, std::optional<double> largest = {},
                   const lab::Image* mask = nullptr) {
    CompareOptions options;
    options.mask = mask;
    const auto picture = errorPicture(test, truth, options, largest);
    REQUIRE_MESSAGE(picture, (picture ? "" : picture.error().message));
    REQUIRE(picture->rgb.size() == size_t(picture->width) * size_t(picture->height) * 3);
    return *picture;
}

// CIE L* of an sRGB colour.
double lightness(const Rgb& rgb) {
    const auto linear = [](unsigned char byte) {
        const double v = double(byte) / 255.0;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 116.0 * std::cbrt(0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2])) -
           16.0;
}

TEST_CASE("viridis is Matplotlib's, and gets lighter all the way") {
    CHECK(viridis(0.0) == Rgb{68, 1, 84});
    CHECK(viridis(1.0) == Rgb{253, 231, 37});
    CHECK(viridis(-3.0) == viridis(0.0));
    CHECK(viridis(1e300) == viridis(1.0));
    // Entries of Matplotlib's 256 that are not in our table; a level is left for interpolation.
    const struct {
        double entry, rgb[3];
    } entries[] = {{64, {0.229739, 0.322361, 0.545706}},
                   {128, {0.127568, 0.566949, 0.550556}},
                   {192, {0.369214, 0.788888, 0.382914}},
                   {253, {0.974417, 0.903590, 0.130215}}};
    for (const auto& [entry, rgb] : entries)
        for (size_t c = 0; c < 3; ++c)
            CHECK(std::abs(double(viridis(entry / 255.0)[c]) - 255.0 * rgb[c]) <=
                  1.0 + 0.5); // and for rounding
    for (int i = 0; i < 100; ++i)
        CHECK(lightness(viridis(double(i) / 100.0)) < lightness(viridis(double(i + 1) / 100.0)));
}

TEST_CASE("a pixel has the colour of its largest channel's difference") {
    const lab::Image truth({4, 1}, 3, 1.0f);
    const lab::Image test = rowOf({1, 1, 1, 1, 1.25f, 1.5f, 0, 1, 1, 1, 1, 9}, 3);
    const lab::Picture picture = shown(test, truth, 1.0);
    CHECK(at(picture, 0, 0) == viridis(0.0));
    CHECK(at(picture, 1, 0) == viridis(0.5));
    CHECK(at(picture, 2, 0) == viridis(1.0));
    CHECK(at(picture, 3, 0) == viridis(1.0)); // beyond the end of the bar
}

TEST_CASE("what is left out has colours of its own") {
    const lab::Image test = rowOf({1, nan, 2, nan}), truth({4, 1}, 1, 1.0f), mask = rowOf({1, 1, 0, 0});
    const lab::Picture picture = shown(test, truth, {}, &mask);
    CHECK(at(picture, 0, 0) == viridis(0.0));
    CHECK(at(picture, 1, 0) == Rgb{255, 0, 255});
    CHECK(at(picture, 2, 0) == Rgb{64, 64, 64});
    CHECK(at(picture, 3, 0) == Rgb{64, 64, 64});
}

TEST_CASE("without a largest difference it is the 99th percentile, rounded up") {
    // Differences of 1 to 200: the 99th percentile is 198, which rounds up to 200.
    const lab::Image truth({200, 1}, 1, 0.0f);
    const lab::Image ramp = imageOf({200, 1}, 1, [](int x, int, int) { return double(x + 1); });
    const lab::Picture picture = shown(ramp, truth);
    for (const int x : {0, 20, 99, 150, 199}) CHECK(at(picture, x, 0) == viridis(double(x + 1) / 200.0));
    // A single pixel of 200 differs: the percentile is 0, so its own difference counts, 3, which rounds up
    // to 5.
    lab::Image one = truth;
    *one.at(7, 0) = 3.0f;
    CHECK(at(shown(one, truth), 7, 0) == viridis(0.6));
    CHECK(at(shown(truth, truth), 7, 0) == viridis(0.0));
}

TEST_CASE("numbers are rounded up to 1, 2 or 5 times a power of ten") {
    const std::pair<double, double> all[] = {
        {1.0, 1.0},   {1.01, 2.0},    {2.0, 2.0},       {3.0, 5.0},   {5.1, 10.0},
        {0.03, 0.05}, {0.001, 0.001}, {1000.0, 1000.0}, {7e-9, 1e-8}, {double(0.2f), 0.2}};
    for (const auto& [value, expected] : all)
        CHECK(roundedUp(value) == Approx(expected).epsilon(1e-12)); // powers of ten round
}

TEST_CASE("a scale has a handful of labels, the ends among them") {
    const auto checkTicks = [](double largest, std::initializer_list<double> expected) {
        const std::vector<double> ticks = ticksUpTo(largest);
        REQUIRE(ticks.size() == expected.size());
        size_t i = 0;
        for (const double tick : expected) CHECK(ticks[i++] == Approx(tick).epsilon(1e-12));
    };
    checkTicks(1.0, {0.0, 0.2, 0.4, 0.6, 0.8, 1.0});
    checkTicks(2.0, {0.0, 0.5, 1.0, 1.5, 2.0});
    checkTicks(0.05, {0.0, 0.01, 0.02, 0.03, 0.04, 0.05});
    checkTicks(0.37, {0.0, 0.1, 0.2, 0.3, 0.37});
    checkTicks(0.34, {0.0, 0.1, 0.2, 0.34}); // 0.3 would touch it
}

TEST_CASE("the bar stands at the right, from 0 below to the largest above") {
    for (const Extent2D extent : {Extent2D{1, 1}, {60, 40}, {30, 150}, {20, 500}}) {
        const lab::Image image(extent, 1, 1.0f);
        const lab::Picture picture = shown(image, image, 1.0);
        CHECK(picture.height >= extent.height);
        int barColumns = 0;
        for (int x = extent.width; x < picture.width; ++x) {
            int last = -1, first = -1; // rows of the ends
            for (int y = 0; y < picture.height; ++y) {
                if (at(picture, x, y) == viridis(1.0) && first < 0) first = y;
                if (at(picture, x, y) == viridis(0.0)) last = y;
            }
            barColumns += first >= 0 && last > first;
            for (int y = first; first >= 0 && y < last; ++y)
                CHECK(lightness(at(picture, x, y)) > lightness(at(picture, x, y + 1)) - 0.5); // 8-bit steps
        }
        CHECK(barColumns >= 8);
        CHECK(shown(image, image, 2.0).rgb != picture.rgb); // its labels say something else
    }
}

} // namespace
} // namespace rebound::metrics
