// SPDX-License-Identifier: MIT
#include "lab/metrics/ssim.hpp"

#include "lab/metrics/separable_filter.hpp"

namespace rebound::metrics {

namespace {

constexpr double deviation = 1.5; // of the window [pixels]
constexpr int windowRadius = 5;
constexpr double c1 = 0.01 * 0.01; // (K L)^2 with a range L of 1
constexpr double c2 = 0.03 * 0.03;

Plane productOf(const Plane& a, const Plane& b) {
    Plane product(a.width, a.height);
    for (size_t i = 0; i < product.values.size(); ++i) product.values[i] = a.values[i] * b.values[i];
    return product;
}

Plane windowMean(const Plane& plane) {
    const Weights window = gaussianWeights(1.0 / (2.0 * deviation * deviation), windowRadius);
    return filtered(plane, window, window);
}

} // namespace

Plane ssimMap(const Plane& a, const Plane& b) {
    const Plane meanA = windowMean(a), meanB = windowMean(b);
    const Plane meanAA = windowMean(productOf(a, a)), meanBB = windowMean(productOf(b, b));
    const Plane meanAB = windowMean(productOf(a, b));
    Plane result(a.width, a.height);
    for (size_t i = 0; i < result.values.size(); ++i) {
        const double ma = meanA.values[i], mb = meanB.values[i];
        const double variances = (meanAA.values[i] - ma * ma) + (meanBB.values[i] - mb * mb);
        const double covariance = meanAB.values[i] - ma * mb;
        result.values[i] =
            (2.0 * ma * mb + c1) * (2.0 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variances + c2));
    }
    return result;
}

} // namespace rebound::metrics
