// SPDX-License-Identifier: MIT
#include "lab/metrics/pointwise_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rebound::metrics {

namespace {

// Calls body(t, r) for every value that counts, from the first row to the last: sums have one order.
template <class Body>
void forEachValue(const lab::Image& test, const lab::Image& truth, const ComparedPixels& pixels,
                  const Body& body) {
    const size_t channels = size_t(test.channels);
    for (size_t i = 0; i < pixels.states.size(); ++i)
        if (pixels.states[i] == PixelState::counts)
            for (size_t c = i * channels; c < (i + 1) * channels; ++c)
                body(double(test.data[c]), double(truth.data[c]));
}

double square(double value) { return value * value; }

// A floor of a hundredth of the mean keeps dark pixels from deciding alone.
double relativeSquaredError(double t, double r, double truthMean) {
    return square(t - r) / (square(r) + square(0.01 * truthMean));
}

double symmetricError(double t, double r) {
    return t == r ? 0.0 : 2.0 * std::abs(t - r) / (std::abs(t) + std::abs(r));
}

// What halves of the truth tell, as sums over all values.
struct NoiseFreeSums {
    double squares = 0.0;  // (t - a) (t - b)
    double variance = 0.0; // of that sum, by the truth's noise
    double noise = 0.0;    // ((a - b) / 2)^2: the variance of the halves' mean
};

// (t - a) (t - b) = (t - r)^2 - d^2 with r = (a + b) / 2 and d = (a - b) / 2. Noise of variance v in each half gives it the
// variance 2 e^2 v + v^2, where e is the error, and that is what (2 (t - r) d)^2 is in the mean. A pixel's channels come
// from the same paths, so that they are summed before they are squared; pixels are independent.
NoiseFreeSums noiseFreeSums(const lab::Image& test, const TruthHalves& halves, const ComparedPixels& pixels) {
    NoiseFreeSums sums;
    const size_t channels = size_t(test.channels);
    for (size_t i = 0; i < pixels.states.size(); ++i) {
        if (pixels.states[i] != PixelState::counts) continue;
        double deviation = 0.0;
        for (size_t c = i * channels; c < (i + 1) * channels; ++c) {
            const double t = double(test.data[c]), a = double(halves.a->data[c]),
                         b = double(halves.b->data[c]);
            const double d = (a - b) / 2.0;
            sums.squares += (t - a) * (t - b);
            sums.noise += d * d;
            deviation += 2.0 * (t - (a + b) / 2.0) * d;
        }
        sums.variance += square(deviation);
    }
    return sums;
}

// Replaces the RMSE by one that the truth's noise is taken out of.
void takeNoiseOut(const lab::Image& test, const CompareOptions& options, const ComparedPixels& pixels,
                  double count, ErrorMetrics& metrics) {
    double squares = square(metrics.rmse), error = std::numeric_limits<double>::quiet_NaN();
    if (options.halves) {
        const NoiseFreeSums sums = noiseFreeSums(test, *options.halves, pixels);
        squares = sums.squares / count;
        error = std::sqrt(sums.variance) / count;
        metrics.truthNoise = std::sqrt(sums.noise / count) / metrics.truthMean;
    } else if (options.truthNoise) {
        metrics.truthNoise = *options.truthNoise;
        squares -= square(metrics.truthNoise * metrics.truthMean);
    } else {
        return;
    }
    metrics.rmse = std::sqrt(std::max(squares, 0.0));
    // Of a root; where what is left is not above its own error, no more is known than that.
    metrics.relativeRmseError =
        (squares > error ? error / (2.0 * metrics.rmse) : std::sqrt(error)) / metrics.truthMean;
}

} // namespace

double largestDifference(const float* test, const float* truth, int channels) {
    double largest = 0.0;
    for (int c = 0; c < channels; ++c)
        largest = std::max(largest, std::abs(double(test[c]) - double(truth[c])));
    return largest;
}

std::vector<double> largestDifferences(const lab::Image& test, const lab::Image& truth,
                                       const ComparedPixels& pixels) {
    std::vector<double> differences;
    differences.reserve(pixels.counting);
    const size_t channels = size_t(test.channels);
    for (size_t i = 0; i < pixels.states.size(); ++i)
        if (pixels.states[i] == PixelState::counts)
            differences.push_back(
                largestDifference(&test.data[i * channels], &truth.data[i * channels], test.channels));
    return differences;
}

double percentileOf(std::vector<double>& values, size_t percent) {
    const size_t rank = (values.size() * percent + 99) / 100; // rounded up, from 1
    const auto found = values.begin() + std::ptrdiff_t(std::max<size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), found, values.end());
    return *found;
}

void measurePointwise(const lab::Image& test, const lab::Image& truth, const CompareOptions& options,
                      const ComparedPixels& pixels, ErrorMetrics& metrics) {
    const double count = double(pixels.counting) * double(test.channels);
    double sum = 0.0, truthSum = 0.0, squares = 0.0, differences = 0.0, symmetric = 0.0;
    forEachValue(test, truth, pixels, [&](double t, double r) {
        sum += t;
        truthSum += r;
        squares += square(t - r);
        differences += t - r;
        symmetric += symmetricError(t, r);
    });
    metrics.mean = sum / count;
    metrics.truthMean = truthSum / count;
    metrics.rmse = std::sqrt(squares / count);
    metrics.smape = symmetric / count;
    metrics.bias = differences / count;

    metrics.relativeRmse = metrics.relMse = std::numeric_limits<double>::quiet_NaN();
    if (metrics.truthMean > 0.0) {
        double relative = 0.0;
        forEachValue(test, truth, pixels,
                     [&](double t, double r) { relative += relativeSquaredError(t, r, metrics.truthMean); });
        takeNoiseOut(test, options, pixels, count, metrics);
        metrics.relativeRmse = metrics.rmse / metrics.truthMean;
        metrics.relMse = relative / count;
    }

    std::vector<double> largest = largestDifferences(test, truth, pixels);
    metrics.percentile95 = percentileOf(largest, 95);
    metrics.percentile99 = percentileOf(largest, 99);
}

} // namespace rebound::metrics
