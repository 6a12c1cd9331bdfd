// SPDX-License-Identifier: MIT
#include "lab/metrics/compared_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace rebound::metrics {

namespace {

std::string sizeOf(const lab::Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height) + " pixels";
}

std::string channelsOf(const lab::Image& image) {
    return std::to_string(image.channels) + (image.channels == 1 ? " channel" : " channels");
}

Error unfit(std::string message) { return {ErrorCode::invalidData, std::move(message)}; }

Result<> checkFit(const lab::Image& test, const lab::Image& truth, const lab::Image* mask) {
    if (test.empty() || truth.empty())
        return unfit(std::string(test.empty() ? "the picture under test" : "the truth") +
                     " is empty; at least one pixel was expected");
    if (!(test.extent() == truth.extent()))
        return unfit("the picture under test is " + sizeOf(test) + ", the truth " + sizeOf(truth) +
                     "; one size was expected");
    if (test.channels != truth.channels)
        return unfit("the picture under test has " + channelsOf(test) + ", the truth " + channelsOf(truth) +
                     "; the same number was expected");
    if (test.channels != 1 && test.channels != 3)
        return unfit("the pictures have " + channelsOf(test) + "; 1 or 3 were expected");
    if (mask && !(mask->extent() == truth.extent()))
        return unfit("the mask is " + sizeOf(*mask) + ", the pictures " + sizeOf(truth) +
                     "; one size was expected");
    if (mask && mask->channels != 1) return unfit("the mask has " + channelsOf(*mask) + "; 1 was expected");
    return {};
}

// Why there is nothing to compare.
Error noneCounts(const ComparedPixels& pixels) {
    std::string message = "no pixel can be compared: of " + std::to_string(pixels.states.size()) + ", ";
    if (pixels.maskedOut > 0) message += std::to_string(pixels.maskedOut) + " are masked out and ";
    return unfit(message + std::to_string(pixels.notFinite) + " are not finite; at least one was expected");
}

} // namespace

bool isFinite(const float* pixel, int channels) {
    return std::all_of(pixel, pixel + channels, [](float value) { return std::isfinite(value); });
}

Result<ComparedPixels> classifyPixels(const lab::Image& test, const lab::Image& truth,
                                      const lab::Image* mask) {
    if (auto fits = checkFit(test, truth, mask); !fits) return fits.error();
    ComparedPixels pixels;
    pixels.states.assign(test.data.size() / size_t(test.channels), PixelState::counts);
    const float* t = test.data.data();
    const float* r = truth.data.data();
    for (size_t i = 0; i < pixels.states.size(); ++i, t += test.channels, r += truth.channels) {
        if (mask && !(mask->data[i] > 0.0f)) {
            pixels.states[i] = PixelState::maskedOut;
            ++pixels.maskedOut;
            continue;
        }
        const bool badTest = !isFinite(t, test.channels), badTruth = !isFinite(r, truth.channels);
        pixels.notFiniteInTest += badTest;
        pixels.notFiniteInTruth += badTruth;
        if (badTest || badTruth) {
            pixels.states[i] = PixelState::notFinite;
            ++pixels.notFinite;
        } else {
            ++pixels.counting;
        }
    }
    if (pixels.counting == 0) return noneCounts(pixels);
    return pixels;
}

} // namespace rebound::metrics
