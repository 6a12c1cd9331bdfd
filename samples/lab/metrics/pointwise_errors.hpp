// SPDX-License-Identifier: MIT
// Measures that look at one pixel at a time.
#pragma once

#include "lab/metrics/compared_pixels.hpp"
#include "lab/metrics/metrics.hpp"

namespace rebound::metrics {

// Fills in everything from `mean` to `percentile99`, of what the options say about the truth's noise.
void measurePointwise(const lab::Image& test, const lab::Image& truth, const CompareOptions&,
                      const ComparedPixels&, ErrorMetrics&);

// The largest |t - r| among a pixel's channels.
double largestDifference(const float* test, const float* truth, int channels);

// largestDifference of every pixel that counts, in no particular order.
std::vector<double> largestDifferences(const lab::Image& test, const lab::Image& truth,
                                       const ComparedPixels&);

// The least of the values that `percent` per cent of them do not exceed, 1 to 100 (nearest rank). There has
// to be a value; they are put in another order.
double percentileOf(std::vector<double>& values, size_t percent);

} // namespace rebound::metrics
