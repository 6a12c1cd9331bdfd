// SPDX-License-Identifier: MIT
#include "lab/metrics/separable_filter.hpp"

#include "lab/rays/parallel_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rebound::metrics {

namespace {

int radiusOf(const Weights& weights) { return int(weights.size() / 2); }

// A weight at a time over a whole row, so that compilers can use vector instructions.
void addScaled(double* sums, const double* values, double weight, int count) {
    for (int x = 0; x < count; ++x) sums[x] += weight * values[x];
}

} // namespace

Plane filteredAlongRows(const Plane& plane, const Weights& weights) {
    Plane result(plane.width, plane.height);
    const int radius = radiusOf(weights);
    lab::parallelRows(plane.height, 0, {}, [&](int y) {
        const double* row = plane.row(y);
        std::vector<double> extended(size_t(plane.width) + 2 * size_t(radius), row[0]);
        std::copy_n(row, plane.width, extended.begin() + radius);
        std::fill_n(extended.end() - radius, radius, row[plane.width - 1]);
        for (size_t k = 0; k < weights.size(); ++k)
            addScaled(result.row(y), extended.data() + k, weights[k], plane.width);
    });
    return result;
}

Plane filteredAlongColumns(const Plane& plane, const Weights& weights) {
    Plane result(plane.width, plane.height);
    const int radius = radiusOf(weights);
    lab::parallelRows(plane.height, 0, {}, [&](int y) {
        for (int k = -radius; k <= radius; ++k)
            addScaled(result.row(y), plane.row(std::clamp(y + k, 0, plane.height - 1)),
                      weights[size_t(k + radius)], plane.width);
    });
    return result;
}

Plane filtered(const Plane& plane, const Weights& alongRows, const Weights& alongColumns) {
    return filteredAlongColumns(filteredAlongRows(plane, alongRows), alongColumns);
}

Weights gaussianWeights(double k, int radius) {
    Weights weights;
    for (int x = -radius; x <= radius; ++x) weights.push_back(std::exp(-k * double(x) * double(x)));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) weight /= sum;
    return weights;
}

} // namespace rebound::metrics
