// SPDX-License-Identifier: MIT
// How far a picture is from the truth, in the measures that rendering uses.
#pragma once

#include "lab/images/image.hpp"
#include "lab/images/image_files.hpp"
#include "rebound/result.hpp"

#include <cstddef>
#include <limits>
#include <optional>

namespace rebound::metrics {

// The truth as the mean of two estimates of the same light, whose noise is independent.
struct TruthHalves {
    const lab::Image* a = nullptr;
    const lab::Image* b = nullptr;
};

// What the pictures show, of their size.
struct Surfaces {
    const lab::Image* depth =
        nullptr; // 1 channel: along the viewing axis [m]; not above 0 or infinite: no surface
    const lab::Image* normal = nullptr; // 3 channels, in any space and of any length
};

struct CompareOptions {
    const lab::Image* mask = nullptr; // 1 channel of the same size: only pixels where it is above 0 count
    // Of both pictures for SSIM and FLIP; without one, the automatic curve of the truth.
    std::optional<lab::ToneCurve> curve;
    // Of FLIP's observer, 1 to 1000: 0.7 m from a 3840 pixels, 0.7 m wide monitor.
    double pixelsPerDegree = 67.0;
    // How RMSE is freed of the truth's noise; with neither, it is not. Both pictures of halves have the truth's size and
    // channels, and the truth is their mean.
    std::optional<TruthHalves> halves;
    std::optional<double> truthNoise; // its standard deviation over all values, over their mean, 0 to 10
    std::optional<Surfaces> surfaces; // for the pattern; without them it is not measured
};

// Values that are not finite in either picture are left out with their pixel, and counted. Means are over all
// channels of all pixels that count, with t a value under test and r the truth's. docs/metrics.md says what
// each is good for.
struct ErrorMetrics {
    size_t pixels = 0;          // that count
    size_t maskedOut = 0;       // left out by the mask
    size_t notFinite = 0;       // not masked out, but left out, as one of their values was not finite
    size_t notFiniteInTest = 0; // those of them that are so in this picture, whatever the other one has
    size_t notFiniteInTruth = 0;
    double mean = 0.0;      // of t
    double truthMean = 0.0; // of r
    // sqrt(mean((t - r)^2)); with halves a and b of the truth, sqrt(mean((t - a) (t - b))), which their noise does not
    // add to; with the truth's noise alone, its square is taken off. 0 where nothing else is left.
    double rmse = 0.0;
    double relativeRmse = 0.0; // rmse / mean(r); NaN, as not defined, unless mean(r) is above 0
    // Of halves, else NaN: the standard error of relativeRmse, by the truth's noise.
    double relativeRmseError = std::numeric_limits<double>::quiet_NaN();
    // Root mean square of the truth's noise, over mean(r): by halves, or as given; else NaN.
    double truthNoise = std::numeric_limits<double>::quiet_NaN();
    // With surfaces, else NaN: over blocks of 8x8 pixels that lie on one smooth surface, the standard deviation of the
    // blocks' mean t - r, over the mean of r in them; halves take the truth's noise out. NaN unless that mean is above 0.
    double pattern = std::numeric_limits<double>::quiet_NaN();
    size_t smoothBlocks = 0;   // so many blocks
    double relMse = 0.0;       // mean((t - r)^2 / (r^2 + (0.01 mean(r))^2)); likewise
    double smape = 0.0;        // mean(2 |t - r| / (|t| + |r|)), 0 where both are 0: symmetric MAPE, 0 to 2
    double bias = 0.0;         // mean(t - r)
    double percentile95 = 0.0; // of a pixel's largest |t - r|: what 95 % of the pixels do not exceed
    double percentile99 = 0.0;
    double ssim = 0.0; // mean structural similarity of the tone-mapped luminance, 1: the same
    double flip = 0.0; // mean LDR-FLIP of the tone-mapped pictures, 0: the same, to 1
};

// Both pictures have the same size and number of channels, 1 or 3. Fails where they have not, where no pixel
// counts, where surfaces do not fit or no block is smooth, and for an exposure or pixels per degree out of range.
Result<ErrorMetrics> compareImages(const lab::Image& test, const lab::Image& truth,
                                   const CompareOptions& = {});

// |t - r|, the largest of a pixel's channels, through a perceptually uniform colour map from 0 to `largest`,
// with a bar at the right that says what the colours mean; not finite is magenta, what a mask leaves out is
// dark grey. Without `largest` it is the 99th percentile, rounded up to 1, 2 or 5 times a power of ten; where
// that is 0, the maximum; where that is 0, 1. The bar adds to the width, and to the height of pictures that
// are lower than it. Fails as compareImages does, and for a `largest` that is not above 0.
Result<lab::Picture> errorPicture(const lab::Image& test, const lab::Image& truth, const CompareOptions& = {},
                                  std::optional<double> largest = {});

} // namespace rebound::metrics
