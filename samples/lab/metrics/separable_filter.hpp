// SPDX-License-Identifier: MIT
// Correlation with a product of two rows of weights. Beyond the border, the border's pixels go on.
#pragma once

#include "lab/metrics/plane.hpp"

namespace rebound::metrics {

// An odd number of them; the middle one is the pixel's own.
using Weights = std::vector<double>;

Plane filteredAlongRows(const Plane&, const Weights&);
Plane filteredAlongColumns(const Plane&, const Weights&);
// Both, one after the other.
Plane filtered(const Plane&, const Weights& alongRows, const Weights& alongColumns);

// exp(-k x^2) for x from -radius to radius, divided by their sum.
Weights gaussianWeights(double k, int radius);

} // namespace rebound::metrics
