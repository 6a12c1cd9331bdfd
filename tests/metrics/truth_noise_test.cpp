// SPDX-License-Identifier: MIT
// Errors against a noisy truth, with its noise taken out.
#include "test_pictures.hpp"

#include <cmath>
#include <random>

namespace rebound::metrics {
namespace {

using doctest::Approx;

constexpr double rounding = 1e-6; // of floats that hold the test's numbers

struct NoisyTruth {
    lab::Image a, b, mean;
};

// 2 everywhere, with noise of that deviation in each half; a pixel's channels share it or have their own.
NoisyTruth noisyTruth(Extent2D extent, double deviation, bool isShared, unsigned seed) {
    std::mt19937 bits(seed);
    std::normal_distribution<double> normal(0.0, deviation);
    NoisyTruth truth{lab::Image(extent, 3), lab::Image(extent, 3), lab::Image(extent, 3)};
    for (lab::Image* half : {&truth.a, &truth.b})
        for (size_t i = 0; i < half->data.size(); i += 3) {
            const double shared = normal(bits);
            for (size_t c = 0; c < 3; ++c)
                half->data[i + c] = float(2.0 + (isShared ? shared : normal(bits)));
        }
    for (size_t i = 0; i < truth.mean.data.size(); ++i)
        truth.mean.data[i] = 0.5f * (truth.a.data[i] + truth.b.data[i]);
    return truth;
}

ErrorMetrics comparedWithHalves(const lab::Image& test, const NoisyTruth& truth) {
    CompareOptions options;
    options.halves = TruthHalves{&truth.a, &truth.b};
    return compared(test, truth.mean, options);
}

TEST_CASE("with halves a and b the squared error is the mean of (t - a) (t - b)") {
    const lab::Image a = rowOf({1.0f, 1.0f}), b = rowOf({3.0f, 3.0f}), mean = rowOf({2.0f, 2.0f});
    CompareOptions options;
    options.halves = TruthHalves{&a, &b};
    const ErrorMetrics m = compared(rowOf({4.0f, 5.0f}), mean, options);
    CHECK(m.rmse == Approx(std::sqrt((3.0 * 1.0 + 4.0 * 2.0) / 2.0)).epsilon(rounding));
    CHECK(m.relativeRmse == Approx(m.rmse / 2.0).epsilon(rounding));
    CHECK(m.truthNoise == Approx(1.0 / 2.0).epsilon(rounding));
    CHECK(m.bias == 2.5); // of the mean of both, which noise does not bend
    // Nothing but noise is left: between the halves, the product is below 0.
    CHECK(compared(rowOf({2.5f, 2.0f}), mean, options).rmse == 0.0);
}

TEST_CASE("what noise adds to the error is gone, and the standard error says what remains of it") {
    const lab::Image test({100, 100}, 3, 2.1f);
    const NoisyTruth truth = noisyTruth({100, 100}, 0.5, false, 1);
    // Against the mean of both, noise of 0.5 / sqrt(2) is 3.5 times the error of 0.1.
    CHECK(compared(test, truth.mean).rmse > 0.3);
    const ErrorMetrics m = comparedWithHalves(test, truth);
    CHECK(std::abs(m.relativeRmse - 0.05) < 4.0 * m.relativeRmseError);
    CHECK(m.relativeRmseError < 0.01);
    CHECK(m.truthNoise == Approx(0.5 / std::sqrt(2.0) / 2.0).epsilon(0.02)); // of 30000 values
}

TEST_CASE("the standard error is that of repeated experiments, whether channels share their noise or not") {
    for (const bool isShared : {false, true}) {
        CAPTURE(isShared);
        constexpr int experiments = 600;
        double squares = 0.0;
        for (int i = 0; i < experiments; ++i) {
            const lab::Image test({24, 24}, 3, 2.4f);
            const ErrorMetrics m =
                comparedWithHalves(test, noisyTruth({24, 24}, 0.4, isShared, unsigned(i + 1)));
            squares += std::pow((m.relativeRmse - 0.2) / m.relativeRmseError, 2.0);
        }
        // The deviation of a variance of 600 values is 6 % of it; a root is nearly linear over its error here.
        CHECK(std::sqrt(squares / experiments) == Approx(1.0).epsilon(0.15));
    }
}

TEST_CASE("noise that is known as a figure is taken off the squared error") {
    CompareOptions options;
    options.truthNoise = 0.3;
    const ErrorMetrics m = compared(rowOf({2.5f, 1.5f}), rowOf({1.0f, 1.0f}), options);
    CHECK(m.rmse == Approx(std::sqrt((2.25 + 0.25) / 2.0 - 0.09)).epsilon(rounding));
    CHECK(m.truthNoise == 0.3);
    CHECK(std::isnan(m.relativeRmseError));
    options.truthNoise = 9.0; // more than there is
    CHECK(compared(rowOf({2.5f, 1.5f}), rowOf({1.0f, 1.0f}), options).rmse == 0.0);
}

TEST_CASE("without either, nothing is taken out, and nothing is claimed") {
    const ErrorMetrics m = compared(rowOf({2.5f}), rowOf({1.0f}));
    CHECK(m.rmse == 1.5);
    CHECK(std::isnan(m.truthNoise));
    CHECK(std::isnan(m.relativeRmseError));
}

TEST_CASE("halves that do not fit and noise out of range are refused") {
    const lab::Image truth = rowOf({1.0f, 1.0f}), other = rowOf({1.0f});
    CompareOptions options;
    options.halves = TruthHalves{&truth, &other};
    CHECK(!compareImages(truth, truth, options));
    options.halves.reset();
    options.truthNoise = -0.1;
    const auto refused = compareImages(truth, truth, options);
    REQUIRE(!refused);
    CHECK(refused.error().message.find("truthNoise is -0.1") != std::string::npos);
}

} // namespace
} // namespace rebound::metrics
