// SPDX-License-Identifier: MIT
#include "lab/metrics/compared_pixels.hpp"
#include "lab/metrics/displayed_pair.hpp"
#include "lab/metrics/flip.hpp"
#include "lab/metrics/metrics.hpp"
#include "lab/metrics/pattern.hpp"
#include "lab/metrics/pointwise_errors.hpp"
#include "lab/metrics/ssim.hpp"

#include <cmath>
#include <new>
#include <string>

namespace rebound::metrics {

namespace {

double meanOf(const Plane& plane, const ComparedPixels& pixels) {
    double sum = 0.0;
    for (size_t i = 0; i < pixels.states.size(); ++i)
        if (pixels.states[i] == PixelState::counts) sum += plane.values[i];
    return sum / double(pixels.counting);
}

Result<> checkOptions(const CompareOptions& options) {
    if (!(options.pixelsPerDegree >= 1.0 && options.pixelsPerDegree <= 1000.0))
        return invalidArgument("pixelsPerDegree is " + std::to_string(options.pixelsPerDegree) +
                               "; 1 to 1000 was expected");
    if (options.curve && !(options.curve->exposure > 0.0f && std::isfinite(options.curve->exposure)))
        return invalidArgument("the exposure is " + std::to_string(options.curve->exposure) +
                               "; a finite number above 0 was expected");
    if (options.truthNoise && !(*options.truthNoise >= 0.0 && *options.truthNoise <= 10.0))
        return invalidArgument("truthNoise is " + std::to_string(*options.truthNoise) +
                               "; 0 to 10 was expected");
    return {};
}

Result<> checkHalves(const lab::Image& truth, const CompareOptions& options) {
    if (!options.halves) return {};
    for (const lab::Image* half : {options.halves->a, options.halves->b})
        if (!(half->extent() == truth.extent()) || half->channels != truth.channels)
            return Error{
                ErrorCode::invalidData,
                "the truth's halves are not of its size and channels; two pictures like it were expected"};
    return {};
}

Result<ErrorMetrics> measure(const lab::Image& test, const lab::Image& truth, const CompareOptions& options) {
    if (auto fit = checkHalves(truth, options); !fit) return fit.error();
    const auto pixels = classifyPixels(test, truth, options.mask);
    if (!pixels) return pixels.error();
    ErrorMetrics metrics;
    metrics.pixels = pixels->counting;
    metrics.maskedOut = pixels->maskedOut;
    metrics.notFinite = pixels->notFinite;
    metrics.notFiniteInTest = pixels->notFiniteInTest;
    metrics.notFiniteInTruth = pixels->notFiniteInTruth;
    measurePointwise(test, truth, options, *pixels, metrics);
    if (auto done = measurePattern(test, truth, options, *pixels, metrics); !done) return done.error();
    const lab::ToneCurve curve = options.curve ? *options.curve : lab::automaticToneCurve(truth);
    const DisplayedPair shown = displayedPair(test, truth, *pixels, curve);
    metrics.ssim = meanOf(ssimMap(lumaOf(shown.test), lumaOf(shown.truth)), *pixels);
    metrics.flip = meanOf(flipMap(shown.test, shown.truth, options.pixelsPerDegree), *pixels);
    return metrics;
}

} // namespace

Result<ErrorMetrics> compareImages(const lab::Image& test, const lab::Image& truth,
                                   const CompareOptions& options) {
    if (auto valid = checkOptions(options); !valid) return valid.error();
    try {
        return measure(test, truth, options);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "there is not enough memory to compare the pictures"};
    }
}

} // namespace rebound::metrics
