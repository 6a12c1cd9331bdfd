// SPDX-License-Identifier: MIT
// Structural similarity.
#pragma once

#include "lab/metrics/plane.hpp"

namespace rebound::metrics {

// At each pixel of two pictures of one size, values from 0 to 1. Wang, Bovik, Sheikh, Simoncelli: Image
// Quality Assessment: From Error Visibility to Structural Similarity (2004), equation 13: a Gaussian window
// of 11x11 pixels and a standard deviation of 1.5, K1 = 0.01, K2 = 0.03. Beyond the border, the border's
// pixels go on.
Plane ssimMap(const Plane&, const Plane&);

} // namespace rebound::metrics
