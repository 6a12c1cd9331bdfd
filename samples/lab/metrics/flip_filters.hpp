// SPDX-License-Identifier: MIT
// Filters of FLIP's observer.
#pragma once

#include "lab/metrics/separable_filter.hpp"

namespace rebound::metrics {

// Contrast sensitivity in YCxCz: sums of Gaussians. Blue to yellow takes two.
struct ContrastFilters {
    Weights luminance;
    Weights redGreen;
    Weights blueYellow[2];
    double blueYellowShares[2];
};
ContrastFilters contrastFilters(double pixelsPerDegree);

// Derivatives of a Gaussian along one axis, to be taken with the Gaussian along the other. Positive weights
// sum to 1, negative ones to -1.
struct FeatureFilters {
    Weights gaussian;
    Weights edge;  // first derivative
    Weights point; // second derivative
};
FeatureFilters featureFilters(double pixelsPerDegree);

} // namespace rebound::metrics
