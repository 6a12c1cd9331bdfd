// SPDX-License-Identifier: MIT
// How much of a difference is a pattern that anyone sees: what is left of it after means over blocks, where surfaces are
// smooth.
#pragma once

#include "lab/metrics/compared_pixels.hpp"
#include "lab/metrics/metrics.hpp"

#include <array>
#include <vector>

namespace rebound::metrics {

// Side of a block [pixels]: noise of single pixels has gone from its mean, and what varies from block to block is as wide
// as blotches and stripes are.
inline constexpr int patternBlock = 8;

// Left upper corners of blocks all of whose pixels count and lie on one smooth surface, row by row. Blocks lie side by side
// from the picture's left upper corner; those that its border cuts are left out.
std::vector<std::array<int, 2>> smoothBlocks(const Surfaces&, const ComparedPixels&);

// Fills in `pattern` and `smoothBlocks` by the options' surfaces, if there are any. Fails where they do not fit the
// pictures, or no block is smooth.
Result<> measurePattern(const lab::Image& test, const lab::Image& truth, const CompareOptions&,
                        const ComparedPixels&, ErrorMetrics&);

} // namespace rebound::metrics
