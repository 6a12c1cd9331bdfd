// SPDX-License-Identifier: MIT
#include "lab/metrics/ssim.hpp"

#include "test_pictures.hpp"

#include <algorithm>
#include <cmath>

namespace rebound::metrics {
namespace {

using doctest::Approx;

constexpr double c1 = 1e-4; // 0.01^2
constexpr double c2 = 9e-4; // 0.03^2

// Means of squares less squares of means lose up to 1e-16 against c2 = 9e-4.
constexpr double rounding = 1e-11;

// Of two constants: no variance is left, so that only the first factor remains.
double ofConstants(double a, double b) { return (2.0 * a * b + c1) / (a * a + b * b + c1); }

// The definition at one pixel, with a window that is no product of rows.
double plainSsim(const Plane& a, const Plane& b, int x, int y) {
    double weights = 0.0, ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    for (int pass = 0; pass < 2; ++pass)
        for (int j = -5; j <= 5; ++j)
            for (int i = -5; i <= 5; ++i) {
                const double w = std::exp(-double(i * i + j * j) / (2.0 * 1.5 * 1.5));
                const int column = std::clamp(x + i, 0, a.width - 1),
                          row = std::clamp(y + j, 0, a.height - 1);
                const double va = a.row(row)[column], vb = b.row(row)[column];
                if (pass == 0) {
                    weights += w;
                    ma += w * va;
                    mb += w * vb;
                } else {
                    aa += w / weights * (va - ma / weights) * (va - ma / weights);
                    bb += w / weights * (vb - mb / weights) * (vb - mb / weights);
                    ab += w / weights * (va - ma / weights) * (vb - mb / weights);
                }
            }
    ma /= weights;
    mb /= weights;
    return (2.0 * ma * mb + c1) * (2.0 * ab + c2) / ((ma * ma + mb * mb + c1) * (aa + bb + c2));
}

Plane pattern(int width, int height, int seed) {
    return planeOf(width, height,
                   [seed](int x, int y) { return ((7 * x + 5 * y + x * y * seed) % 32) / 31.0; });
}

TEST_CASE("of constants, SSIM is its luminance factor, at any size") {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {10, 11}, {40, 1}, {23, 17}}) {
        const Plane map = ssimMap(Plane(width, height, 0.25), Plane(width, height, 0.75));
        for (const double value : map.values)
            CHECK(value == Approx(ofConstants(0.25, 0.75)).epsilon(rounding));
    }
}

TEST_CASE("SSIM is its definition, also at borders") {
    for (const auto& [width, height] : {std::pair{19, 14}, {5, 7}}) {
        const Plane a = pattern(width, height, 1), b = pattern(width, height, 3), map = ssimMap(a, b);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                CHECK(map.row(y)[x] == Approx(plainSsim(a, b, x, y)).epsilon(rounding));
    }
}

TEST_CASE("SSIM is 1 of a picture with itself, the same both ways, and below 0 of its negative") {
    const Plane a = pattern(24, 24, 1), b = pattern(24, 24, 3);
    for (const double value : ssimMap(a, a).values) CHECK(value == Approx(1.0).epsilon(rounding));
    CHECK(ssimMap(a, b).values == ssimMap(b, a).values);
    const Plane negative = planeOf(24, 24, [&](int x, int y) { return 1.0 - a.row(y)[x]; });
    for (const double value : ssimMap(a, negative).values) CHECK(value < 0.0);
}

TEST_CASE("compareImages takes SSIM of what is displayed") {
    // 1 - exp(-ln 2) = 1/2 and 1 - exp(-ln(4/3)) = 1/4, which sRGB encodes as 0.735357 and 0.537099.
    const auto encoded = [](double linear) { return 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055; };
    CompareOptions options;
    options.curve = lab::ToneCurve{2.0f};
    for (const int channels : {1, 3}) {
        const lab::Image test({6, 6}, channels, float(std::log(2.0) / 2.0));
        const lab::Image truth({6, 6}, channels, float(std::log(4.0 / 3.0) / 2.0));
        // Pictures and the curve are floats.
        CHECK(compared(test, truth, options).ssim ==
              Approx(ofConstants(encoded(0.5), encoded(0.25))).epsilon(1e-6));
    }
}

} // namespace
} // namespace rebound::metrics
