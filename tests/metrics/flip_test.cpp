// SPDX-License-Identifier: MIT
#include "lab/metrics/flip.hpp"

#include "test_pictures.hpp"

#include <cmath>
#include <string>

namespace rebound::metrics {
namespace {

using doctest::Approx;

struct Pair {
    ColorPlanes test, truth;
};

// value(x, y, channel) at each pixel, sRGB-encoded.
template <class Value>
ColorPlanes colorsOf(int width, int height, const Value& value) {
    ColorPlanes planes;
    for (int c = 0; c < 3; ++c)
        planes[size_t(c)] = planeOf(width, height, [&](int x, int y) { return value(x, y, c); });
    return planes;
}

ColorPlanes uniform(double r, double g, double b) {
    return colorsOf(13, 9, [&](int, int, int c) { return c == 0 ? r : c == 1 ? g : b; });
}

double flipOfUniform(const ColorPlanes& test, const ColorPlanes& truth) {
    const Plane map = flipMap(test, truth, 67.0);
    for (const double value : map.values)
        CHECK(value == Approx(map.values[0]).epsilon(1e-9)); // no pixel is special
    return map.values[0];
}

// Colours in which any channel differs from any other, and test from truth by up to 3/32.
Pair texture() {
    return {colorsOf(24, 16,
                     [](int x, int y, int c) {
                         return double((5 * x + 3 * y + 11 * c + x * y + (x * x + y + c) % 4) % 32) / 32.0;
                     }),
            colorsOf(24, 16, [](int x, int y, int c) {
                return double((5 * x + 3 * y + 11 * c + x * y) % 32) / 32.0;
            })};
}

// An edge between two colours that stands two pixels further right than it should.
Pair movedEdge() {
    const auto edgeAt = [](int column) {
        return colorsOf(32, 32, [column](int x, int, int c) {
            constexpr double left[] = {24, 20, 12}, right[] = {6, 8, 10};
            return (x < column ? left[c] : right[c]) / 32.0;
        });
    };
    return {edgeAt(16), edgeAt(14)};
}

// A white pixel on grey is missing, in a picture that is smaller than the filters.
Pair missingPoint() {
    return {colorsOf(9, 7, [](int, int, int) { return 0.25; }),
            colorsOf(9, 7, [](int x, int y, int) { return x == 4 && y == 3 ? 1.0 : 0.25; })};
}

TEST_CASE("FLIP is 0 of a picture with itself, and the same both ways") {
    const Pair pair = texture();
    for (const double value : flipMap(pair.test, pair.test, 67.0).values) CHECK(value == 0.0);
    CHECK(flipMap(pair.test, pair.truth, 67.0).values == flipMap(pair.truth, pair.test, 67.0).values);
}

// Uniform pictures have no features, so that only colour remains. Green has L = 87.736 and, after Hunt's
// adjustment, a = -75.610, b = 72.981; blue 32.298, 25.578, -34.836: 55.438 + sqrt(101.188^2 + 107.818^2) =
// 203.302 apart.
constexpr double greenToBlue = 203.3017;

double errorOfDistance(double distance) {
    const double largest = std::pow(greenToBlue, 0.7), value = std::pow(distance, 0.7);
    return value < 0.4 * largest ? 0.95 * value / (0.4 * largest)
                                 : 0.95 + 0.05 * (value - 0.4 * largest) / (0.6 * largest);
}

TEST_CASE("the error of uniform colours is that of their distance") {
    CHECK(flipOfUniform(uniform(0, 1, 0), uniform(0, 0, 1)) == Approx(1.0).epsilon(1e-9));
    // Black and white are L = 0 and 100. greenToBlue has seven digits.
    CHECK(flipOfUniform(uniform(0, 0, 0), uniform(1, 1, 1)) == Approx(errorOfDistance(100.0)).epsilon(1e-6));
    CHECK(errorOfDistance(100.0) == Approx(0.967).epsilon(1e-3));
    // Greys have no chroma: L = 116 Y^(1/3) - 16, with Y = ((v + 0.055) / 1.055)^2.4.
    const auto lightness = [](double v) { return 116.0 * std::pow((v + 0.055) / 1.055, 0.8) - 16.0; };
    CHECK(flipOfUniform(uniform(0.5, 0.5, 0.5), uniform(0.6, 0.6, 0.6)) ==
          Approx(errorOfDistance(lightness(0.6) - lightness(0.5))).epsilon(1e-6));
}

// Expected values come from a transcription into plain Python of the authors' own, two-dimensional kernels
// and all, in double precision, for these formulas: github.com/NVlabs/flip, python/flip_api.py,
// compute_ldrflip.
struct Expected {
    const char* name;
    Pair pair;
    double pixelsPerDegree;
    double mean;
    double atFourThree;
    double atCorner; // the upper left
};

TEST_CASE("FLIP is what its authors' implementation computes") {
    const Expected all[] = {
        {"texture", texture(), 67.0, 0.292627534, 0.243972560, 0.254561719},
        {"texture from nearby", texture(), 20.0, 0.474858346, 0.770912763, 0.287031284},
        {"moved edge", movedEdge(), 67.0, 0.155111974, 0.003257667, 0.0},
        {"missing point", missingPoint(), 67.0, 0.124636071, 0.604413011, 0.000543852},
    };
    // The authors' inverse matrix has nine decimals, which makes 1e-7 of a colour's L, a, b of up to 100, and
    // small distances are raised to the power 0.7.
    constexpr double tolerance = 1e-6;
    for (const Expected& expected : all) {
        INFO(std::string(expected.name));
        const Plane map = flipMap(expected.pair.test, expected.pair.truth, expected.pixelsPerDegree);
        CHECK(std::abs(meanOf(map) - expected.mean) <= tolerance);
        CHECK(std::abs(map.row(3)[4] - expected.atFourThree) <= tolerance);
        CHECK(std::abs(map.row(0)[0] - expected.atCorner) <= tolerance);
    }
}

TEST_CASE("errors are 0 to 1, and of fine detail they shrink with distance from the screen") {
    // In linear light 0.6 and 0.364824 are 0.318547 and 0.109536, whose mean is that of 0.5: 0.214041.
    const ColorPlanes grey = colorsOf(41, 41, [](int, int, int) { return 0.5; });
    const ColorPlanes checkered =
        colorsOf(41, 41, [](int x, int y, int) { return (x + y) % 2 ? 0.6 : 0.364824; });
    double before = 1.0;
    for (const double pixelsPerDegree : {10.0, 20.0, 67.0}) {
        const Plane map = flipMap(checkered, grey, pixelsPerDegree);
        for (const double value : map.values) {
            CHECK(value >= 0.0);
            CHECK(value <= 1.0);
        }
        CHECK(map.row(20)[20] < 0.7 * before); // away from the border, which makes stripes of the pattern
        before = map.row(20)[20];
    }
    CHECK(before < 0.01);
}

TEST_CASE("compareImages takes FLIP of what is displayed") {
    // 1 - exp(-200) is 1 in floats: green and blue at their brightest. sRGB's 1.055 - 0.055 rounds in floats.
    const lab::Image green = imageOf({5, 5}, 3, [](int, int, int c) { return c == 1 ? 200.0 : 0.0; });
    const lab::Image blue = imageOf({5, 5}, 3, [](int, int, int c) { return c == 2 ? 200.0 : 0.0; });
    CompareOptions options;
    options.curve = lab::ToneCurve{1.0f};
    CHECK(compared(green, blue, options).flip == Approx(1.0).epsilon(1e-6));
    // A single channel is grey: 1 - exp(-ln 2) = 1/2 linear against white.
    const lab::Image half({5, 5}, 1, std::log(2.0f)), white({5, 5}, 1, 200.0f);
    const double distance = 100.0 - (116.0 * std::cbrt(0.5) - 16.0);
    CHECK(compared(half, white, options).flip == Approx(errorOfDistance(distance)).epsilon(1e-6)); // floats
}

} // namespace
} // namespace rebound::metrics
