// SPDX-License-Identifier: MIT
// What an observer sees of the difference between two pictures that are shown in turn. Andersson, Nilsson,
// Akenine-Moller, Oskarsson, Astrom, Fairchild: FLIP: A Difference Evaluator for Alternating Images (2020),
// for pictures of a display's range.
#pragma once

#include "lab/metrics/plane.hpp"

namespace rebound::metrics {

// The error of each pixel, 0 to 1. Both pictures have one size and are sRGB-encoded red, green and blue, 0
// to 1. pixelsPerDegree: of visual angle, 1 to 1000. Beyond the border, the border's pixels go on.
Plane flipMap(const ColorPlanes& test, const ColorPlanes& truth, double pixelsPerDegree);

} // namespace rebound::metrics
