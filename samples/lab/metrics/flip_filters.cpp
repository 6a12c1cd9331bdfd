// SPDX-License-Identifier: MIT
#include "lab/metrics/flip_filters.hpp"

#include <cmath>
#include <numbers>

namespace rebound::metrics {

namespace {

constexpr double pi = std::numbers::pi;

// a sqrt(pi / b) exp(-pi^2 z^2 / b), z in degrees: the paper's table 1.
struct SensitivityTerm {
    double a;
    double b;
};
constexpr SensitivityTerm luminanceTerm{1.0, 0.0047};
constexpr SensitivityTerm redGreenTerm{1.0, 0.0053};
constexpr SensitivityTerm blueYellowTerms[2] = {{34.1, 0.04}, {13.5, 0.025}};

Weights weightsOf(const SensitivityTerm& term, double pixelsPerDegree, int radius) {
    return gaussianWeights(pi * pi / (term.b * pixelsPerDegree * pixelsPerDegree), radius);
}

// Of a term's weights over the square, before they are divided by it: what it has of a sum of terms.
double volumeOf(const SensitivityTerm& term, double pixelsPerDegree, int radius) {
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x)
        sum += std::exp(-pi * pi * double(x) * double(x) / (term.b * pixelsPerDegree * pixelsPerDegree));
    return term.a * std::sqrt(pi / term.b) * sum * sum;
}

// Divides positive weights by their sum, and negative ones by minus theirs.
Weights balanced(Weights weights) {
    double positive = 0.0, negative = 0.0;
    for (const double weight : weights) (weight > 0.0 ? positive : negative) += weight;
    for (double& weight : weights) weight /= weight > 0.0 ? positive : -negative;
    return weights;
}

} // namespace

ContrastFilters contrastFilters(double pixelsPerDegree) {
    // Three standard deviations of the widest term, for all of them.
    const int radius =
        int(std::ceil(3.0 * std::sqrt(blueYellowTerms[0].b / (2.0 * pi * pi)) * pixelsPerDegree));
    ContrastFilters filters;
    filters.luminance = weightsOf(luminanceTerm, pixelsPerDegree, radius);
    filters.redGreen = weightsOf(redGreenTerm, pixelsPerDegree, radius);
    const double volumes[2] = {volumeOf(blueYellowTerms[0], pixelsPerDegree, radius),
                               volumeOf(blueYellowTerms[1], pixelsPerDegree, radius)};
    for (int i = 0; i < 2; ++i) {
        filters.blueYellow[i] = weightsOf(blueYellowTerms[i], pixelsPerDegree, radius);
        filters.blueYellowShares[i] = volumes[i] / (volumes[0] + volumes[1]);
    }
    return filters;
}

FeatureFilters featureFilters(double pixelsPerDegree) {
    constexpr double width = 0.082; // of what people see as an edge: two standard deviations [degrees]
    const double deviation = 0.5 * width * pixelsPerDegree;
    const double variance = deviation * deviation;
    const int radius = int(std::ceil(3.0 * deviation));
    FeatureFilters filters;
    filters.gaussian = gaussianWeights(1.0 / (2.0 * variance), radius);
    for (int x = -radius; x <= radius; ++x) {
        const double g = filters.gaussian[size_t(x + radius)];
        filters.edge.push_back(-double(x) * g);
        filters.point.push_back((double(x * x) / variance - 1.0) * g);
    }
    filters.edge = balanced(std::move(filters.edge));
    filters.point = balanced(std::move(filters.point));
    return filters;
}

} // namespace rebound::metrics
