// SPDX-License-Identifier: MIT
// Pixels that are not compared: not finite, or masked out.
#include "test_pictures.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace rebound::metrics {
namespace {

using doctest::Approx;

constexpr float infinity = std::numeric_limits<float>::infinity();
const float nan = std::nanf("");

// SSIM of equal windows rounds.
constexpr double rounding = 1e-12;

lab::Image pattern() {
    return imageOf({24, 20}, 3,
                   [](int x, int y, int c) { return 0.1 + ((5 * x + 3 * y + 7 * c) % 16) / 16.0; });
}

std::string refusal(const lab::Image& test, const lab::Image& truth, const CompareOptions& options = {}) {
    const auto metrics = compareImages(test, truth, options);
    const auto picture = errorPicture(test, truth, options);
    REQUIRE_FALSE(metrics);
    REQUIRE_FALSE(picture);
    CHECK(metrics.error().message == picture.error().message);
    return metrics.error().message;
}

TEST_CASE("pixels that are not finite are counted by picture and left out of every measure") {
    const ErrorMetrics m =
        compared(rowOf({nan, 1.0f, infinity, 4.0f, 3.0f}), rowOf({1.0f, -infinity, nan, 2.0f, 2.0f}));
    CHECK(m.pixels == 2);
    CHECK(m.notFinite == 3);
    CHECK(m.notFiniteInTest == 2);
    CHECK(m.notFiniteInTruth == 2);
    CHECK(m.mean == 3.5);
    CHECK(m.truthMean == 2.0);
    CHECK(m.bias == 1.5);
    CHECK(m.rmse == Approx(std::sqrt(2.5)).epsilon(rounding));
    CHECK(m.percentile99 == 2.0);
    CHECK(m.smape == Approx((2.0 * 2.0 / 6.0 + 2.0 * 1.0 / 5.0) / 2.0).epsilon(rounding));
}

TEST_CASE("one channel that is not finite takes its pixel with it") {
    const ErrorMetrics m = compared(rowOf({1, nan, 1, 2, 2, 2}, 3), lab::Image({2, 1}, 3, 1.0f));
    CHECK(m.pixels == 1);
    CHECK(m.mean == 2.0);
}

TEST_CASE("a pixel that is not finite adds nothing to what is seen around it") {
    const lab::Image truth = pattern();
    for (const float bad : {nan, infinity, -infinity}) {
        lab::Image test = truth;
        test.at(9, 8)[1] = bad;
        const ErrorMetrics inTest = compared(test, truth);
        CHECK(inTest.notFiniteInTest == 1);
        CHECK(inTest.flip == 0.0);
        CHECK(inTest.ssim == Approx(1.0).epsilon(rounding));
        const ErrorMetrics inTruth = compared(truth, test);
        CHECK(inTruth.notFiniteInTruth == 1);
        CHECK(inTruth.flip == 0.0);
        CHECK(inTruth.ssim == Approx(1.0).epsilon(rounding));
        const ErrorMetrics inBoth = compared(test, test);
        CHECK(inBoth.notFinite == 1);
        CHECK(inBoth.flip == 0.0);
    }
    lab::Image seen = truth; // the control: a finite difference there is seen
    seen.at(9, 8)[1] = 50.0f;
    CHECK(compared(seen, truth).flip > 1e-4);
    CHECK(compared(seen, truth).ssim < 0.9999);
}

TEST_CASE("a mask leaves pixels out, of every measure and of what is not finite") {
    const lab::Image truth = pattern();
    lab::Image test = truth, mask({24, 20}, 1, 1.0f);
    test.at(9, 8)[1] = 50.0f;
    *mask.at(9, 8) = 0.0f;
    test.at(2, 3)[0] = nan;
    *mask.at(2, 3) = -1.0f;
    test.at(5, 5)[2] = 7.0f;
    *mask.at(5, 5) = nan; // not above 0
    *mask.at(6, 5) = 1e-30f;
    CompareOptions options;
    options.mask = &mask;
    const ErrorMetrics m = compared(test, truth, options);
    CHECK(m.pixels == 24 * 20 - 3);
    CHECK(m.maskedOut == 3);
    CHECK(m.notFinite == 0);
    CHECK(m.rmse == 0.0);
    CHECK(m.percentile99 == 0.0);
    CHECK(m.flip == 0.0);
    CHECK(m.ssim == Approx(1.0).epsilon(rounding));
}

TEST_CASE("a mean is over what the mask leaves") {
    const lab::Image test = rowOf({1.0f, 2.0f, 30.0f}), truth = rowOf({1.0f, 1.0f, 10.0f}),
                     mask = rowOf({1, 1, 0});
    CompareOptions options;
    options.mask = &mask;
    const ErrorMetrics m = compared(test, truth, options);
    CHECK(m.mean == 1.5);
    CHECK(m.truthMean == 1.0);
    CHECK(m.bias == 0.5);
}

TEST_CASE("what does not fit together is refused, by name") {
    const lab::Image image({4, 3}, 3, 1.0f), smaller({4, 2}, 3, 1.0f), grey({4, 3}, 1, 1.0f),
        two({4, 3}, 2, 1.0f);
    CHECK(refusal(smaller, image).find("4x2 pixels, the truth 4x3") != std::string::npos);
    CHECK(refusal(grey, image).find("1 channel, the truth 3 channels") != std::string::npos);
    CHECK(refusal(two, two).find("2 channels; 1 or 3") != std::string::npos);
    CHECK(refusal({}, {}).find("empty") != std::string::npos);
    CHECK(refusal(image, {}).find("the truth is empty") != std::string::npos);
    CompareOptions options;
    options.mask = &smaller;
    CHECK(refusal(image, image, options).find("the mask is 4x2") != std::string::npos);
    options.mask = &image;
    CHECK(refusal(image, image, options).find("the mask has 3 channels") != std::string::npos);
}

TEST_CASE("without a pixel to compare there is no number") {
    const lab::Image image({4, 3}, 1, 1.0f), bad({4, 3}, 1, nan), black({4, 3}, 1, 0.0f);
    CHECK(refusal(bad, image).find("12 are not finite") != std::string::npos);
    CHECK(refusal(image, bad).find("12 are not finite") != std::string::npos);
    CompareOptions options;
    options.mask = &black;
    CHECK(refusal(image, image, options).find("12 are masked out") != std::string::npos);
}

TEST_CASE("numbers out of range are refused") {
    const lab::Image image({2, 2}, 1, 1.0f);
    for (const double wrong : {0.0, 0.99, 1000.5, -1.0, double(nan), double(infinity)}) {
        CompareOptions options;
        options.pixelsPerDegree = wrong;
        CHECK_FALSE(compareImages(image, image, options));
    }
    for (const double right : {1.0, 1000.0}) {
        CompareOptions options;
        options.pixelsPerDegree = right;
        CHECK(compared(image, image, options).flip == 0.0);
    }
    for (const float wrong : {0.0f, -1.0f, nan, infinity}) {
        CompareOptions options;
        options.curve = lab::ToneCurve{wrong};
        CHECK_FALSE(compareImages(image, image, options));
        CHECK_FALSE(errorPicture(image, image, {}, double(wrong)));
    }
}

} // namespace
} // namespace rebound::metrics
