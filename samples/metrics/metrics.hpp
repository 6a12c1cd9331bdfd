// SPDX-License-Identifier: MIT
// How far a picture is from the truth, in the measures that rendering uses.
#pragma once

#include "lab/image.hpp"
#include "lab/image_files.hpp"
#include "rebound/result.hpp"

#include <cstddef>
#include <optional>

namespace rebound::metrics {

struct CompareOptions {
    const lab::Image* mask = nullptr; // 1 channel of the same size: only pixels where it is above 0 count
    // Of both pictures for SSIM and FLIP; without one, the automatic curve of the truth.
    std::optional<lab::ToneCurve> curve;
    double pixelsPerDegree = 67.0;    // of FLIP's observer: 0.7 m from a 3840 pixels, 0.7 m wide monitor
};

// Values that are not finite in either picture are left out with their pixel, and counted. The first eight are over all
// channels of all pixels that count, with t a value under test, r the truth's, and a mean of r above 0.
struct ErrorMetrics {
    size_t pixels = 0;        // that count
    size_t notFinite = 0;     // pixels left out, as one of their values was not finite
    double mean = 0.0;        // of t
    double truthMean = 0.0;   // of r
    double rmse = 0.0;        // sqrt(mean((t - r)^2))
    double relativeRmse = 0.0; // rmse / mean(r)
    double relMse = 0.0;      // mean((t - r)^2 / (r^2 + (0.01 mean(r))^2))
    double smape = 0.0;       // mean(2 |t - r| / (|t| + |r|)), 0 where both are 0: symmetric MAPE, 0 to 2
    double bias = 0.0;        // mean(t - r)
    double percentile95 = 0.0; // of a pixel's largest |t - r|
    double percentile99 = 0.0;
    double ssim = 0.0;        // mean structural similarity of the tone-mapped luminance, 1: the same
    double flip = 0.0;        // mean LDR-FLIP of the tone-mapped pictures, 0: the same, to 1
};

// Both pictures have the same size and number of channels, 1 or 3. Fails where no pixel counts.
Result<ErrorMetrics> compareImages(const lab::Image& test, const lab::Image& truth, const CompareOptions& = {});

// |t - r|, the largest of a pixel's channels, through a perceptually uniform colour map from 0 to `largest`, with a bar
// at the right that says what the colours mean; not finite is magenta, what a mask leaves out is dark grey. Without
// `largest` it is the 99th percentile, rounded up to 1, 2 or 5 times a power of ten.
Result<lab::Picture> errorPicture(const lab::Image& test, const lab::Image& truth, const CompareOptions& = {},
                                  std::optional<double> largest = {});

} // namespace rebound::metrics
