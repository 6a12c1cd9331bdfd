// SPDX-License-Identifier: MIT
#include "test_pictures.hpp"

#include <cmath>

namespace rebound::metrics {
namespace {

using doctest::Approx;

// Sums of a few hundred doubles round by less than 1e-13 of them; values are floats that hold the test's
// numbers.
constexpr double rounding = 1e-12;

TEST_CASE("a constant offset is every measure of difference") {
    const lab::Image truth({7, 5}, 3, 2.0f), test({7, 5}, 3, 2.5f);
    const ErrorMetrics m = compared(test, truth);
    CHECK(m.pixels == 35);
    CHECK(m.notFinite == 0);
    CHECK(m.maskedOut == 0);
    CHECK(m.mean == 2.5);
    CHECK(m.truthMean == 2.0);
    CHECK(m.rmse == Approx(0.5).epsilon(rounding));
    CHECK(m.relativeRmse == Approx(0.25).epsilon(rounding));
    CHECK(m.relMse == Approx(0.25 / (4.0 + 0.02 * 0.02)).epsilon(rounding));
    CHECK(m.smape == Approx(2.0 * 0.5 / 4.5).epsilon(rounding));
    CHECK(m.bias == Approx(0.5).epsilon(rounding));
    CHECK(m.percentile95 == 0.5);
    CHECK(m.percentile99 == 0.5);
}

TEST_CASE("the same picture has no error") {
    const lab::Image image = imageOf({9, 4}, 3, [](int x, int y, int c) { return 0.1 * (x + 3 * y + c); });
    const ErrorMetrics m = compared(image, image);
    for (const double error :
         {m.rmse, m.relativeRmse, m.relMse, m.smape, m.bias, m.percentile95, m.percentile99, m.flip})
        CHECK(error == 0.0);
    CHECK(m.ssim == Approx(1.0).epsilon(rounding));
}

TEST_CASE("too dark is a bias below 0, and errors of both signs cancel in it alone") {
    CHECK(compared(rowOf({1.0f, 1.0f}), rowOf({1.5f, 2.5f})).bias == -1.0);
    const ErrorMetrics m = compared(rowOf({0.5f, 1.5f, 0.5f, 1.5f}), rowOf({1.0f, 1.0f, 1.0f, 1.0f}));
    CHECK(m.bias == 0.0);
    CHECK(m.rmse == 0.5);
    CHECK(m.smape == Approx((2.0 * 0.5 / 1.5 + 2.0 * 0.5 / 2.5) / 2.0).epsilon(rounding));
}

TEST_CASE("one outlier in a hundred pixels is a tenth of it in RMSE and nothing in percentiles") {
    const lab::Image truth({10, 10}, 1, 1.0f);
    lab::Image test = truth;
    *test.at(3, 7) = 9.0f;
    ErrorMetrics m = compared(test, truth);
    CHECK(m.rmse == Approx(0.8).epsilon(rounding));
    CHECK(m.bias == Approx(0.08).epsilon(rounding));
    CHECK(m.percentile99 == 0.0);
    *test.at(9, 0) = 5.0f; // now 98 pixels are right, and the 99th is this one
    m = compared(test, truth);
    CHECK(m.percentile95 == 0.0);
    CHECK(m.percentile99 == 4.0);
}

TEST_CASE("percentiles of a ramp are its values by rank, in any order") {
    const lab::Image truth({200, 1}, 1, 1.0f);
    // 77 has no divisor in common with 200, so that each of 1 to 200 comes once; signs alternate.
    const lab::Image test = imageOf(
        {200, 1}, 1, [](int x, int, int) { return 1.0 + (x % 2 ? 1.0 : -1.0) * ((x * 77) % 200 + 1); });
    const ErrorMetrics m = compared(test, truth);
    CHECK(m.percentile95 == 190.0);
    CHECK(m.percentile99 == 198.0);
}

TEST_CASE("percentiles take a pixel's worst channel, means take all") {
    const lab::Image truth({4, 1}, 3, 1.0f);
    const lab::Image test = rowOf({1, 1, 2, 1, 4, 1, 0, 1, 1, 1, 1, 1}, 3);
    const ErrorMetrics m = compared(test, truth);
    CHECK(m.percentile99 == 3.0);
    CHECK(m.rmse == Approx(std::sqrt((1.0 + 9.0 + 1.0) / 12.0)).epsilon(rounding));
    CHECK(m.bias == Approx((1.0 + 3.0 - 1.0) / 12.0).epsilon(rounding));
}

TEST_CASE("relMSE divides by the truth at each pixel, and by a hundredth of its mean where that is dark") {
    // The truth's mean is 1: where it is 0, the denominator is 0.01^2.
    const ErrorMetrics dark = compared(rowOf({0.25f, 2.0f}), rowOf({0.0f, 2.0f}));
    CHECK(dark.relMse == Approx(0.5 * 0.0625 / 1e-4).epsilon(rounding));
    const ErrorMetrics bright = compared(rowOf({0.0f, 2.25f}), rowOf({0.0f, 2.0f}));
    CHECK(bright.relMse == Approx(0.5 * 0.0625 / (4.0 + 1e-4)).epsilon(rounding));
    // It does not change with the unit of light; 4 is a power of two, so that floats scale without rounding.
    CHECK(compared(rowOf({1.0f, 8.0f}), rowOf({0.0f, 8.0f})).relMse == Approx(dark.relMse).epsilon(rounding));
}

TEST_CASE("SMAPE is 2 where only one is 0 or signs differ, and 0 where both are 0") {
    CHECK(compared(rowOf({0.0f}), rowOf({3.0f})).smape == 2.0);
    CHECK(compared(rowOf({-1.0f}), rowOf({1.0f})).smape == 2.0);
    CHECK(compared(rowOf({0.0f, 1.0f}), rowOf({0.0f, 3.0f})).smape == 0.5);
}

TEST_CASE("measures relative to a black truth are not defined, all others are") {
    const ErrorMetrics m = compared(lab::Image({4, 4}, 3, 0.5f), lab::Image({4, 4}, 3, 0.0f));
    CHECK(std::isnan(m.relativeRmse));
    CHECK(std::isnan(m.relMse));
    CHECK(m.rmse == 0.5);
    CHECK(m.smape == 2.0);
    CHECK(m.flip > 0.0);
    CHECK(m.ssim < 1.0);
}

TEST_CASE("the largest floats do not overflow") {
    const float largest = 3e38f;
    const ErrorMetrics m = compared(rowOf({largest, -largest}), rowOf({-largest, largest}));
    CHECK(m.rmse == Approx(2.0 * double(largest)).epsilon(rounding));
    CHECK(std::isfinite(m.ssim));
    CHECK(std::isfinite(m.flip));
}

} // namespace
} // namespace rebound::metrics
