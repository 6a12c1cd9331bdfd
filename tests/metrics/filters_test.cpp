// SPDX-License-Identifier: MIT
#include "lab/metrics/flip_filters.hpp"

#include "test_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rebound::metrics {
namespace {

using doctest::Approx;

constexpr double rounding = 1e-12; // a few hundred products of doubles

double sumOf(const Weights& weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

TEST_CASE("a filter is a correlation whose border goes on") {
    const Plane plane = planeOf(7, 5, [](int x, int y) { return double((3 * x * x + 5 * y + x * y) % 11); });
    const Weights alongRows{0.5, -1.0, 2.0, 0.25, 3.0}, alongColumns{1.0, 2.0, -0.5};
    const Plane result = filtered(plane, alongRows, alongColumns);
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x) {
            double expected = 0.0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -2; i <= 2; ++i)
                    expected += alongRows[size_t(i + 2)] * alongColumns[size_t(j + 1)] *
                                plane.row(std::clamp(y + j, 0, 4))[std::clamp(x + i, 0, 6)];
            CHECK(result.row(y)[x] == Approx(expected).epsilon(rounding));
        }
}

TEST_CASE("filters wider than the picture work") {
    const Weights weights = gaussianWeights(0.01, 20);
    const Plane constant = filtered(Plane(3, 2, 0.7), weights, weights);
    for (const double value : constant.values) CHECK(value == Approx(0.7).epsilon(rounding));
}

TEST_CASE("FLIP's contrast filters keep constants, and its features do not see them") {
    for (const double pixelsPerDegree : {1.0, 20.0, 67.0, 300.0}) {
        const ContrastFilters contrast = contrastFilters(pixelsPerDegree);
        for (const Weights* weights :
             {&contrast.luminance, &contrast.redGreen, &contrast.blueYellow[0], &contrast.blueYellow[1]})
            CHECK(sumOf(*weights) == Approx(1.0).epsilon(rounding));
        CHECK(contrast.blueYellowShares[0] + contrast.blueYellowShares[1] == Approx(1.0).epsilon(rounding));
        const FeatureFilters features = featureFilters(pixelsPerDegree);
        CHECK(sumOf(features.gaussian) == Approx(1.0).epsilon(rounding));
        CHECK(std::abs(sumOf(features.edge)) <= rounding);
        CHECK(std::abs(sumOf(features.point)) <= rounding);
    }
}

} // namespace
} // namespace rebound::metrics
