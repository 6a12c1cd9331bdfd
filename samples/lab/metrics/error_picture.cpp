// SPDX-License-Identifier: MIT
#include "lab/metrics/color_bar.hpp"
#include "lab/metrics/color_map.hpp"
#include "lab/metrics/metrics.hpp"
#include "lab/metrics/pointwise_errors.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

namespace rebound::metrics {

namespace {

using Rgb = std::array<unsigned char, 3>;

constexpr Rgb notFiniteColor{255, 0, 255};
constexpr Rgb maskedOutColor{64, 64, 64};

// Of outliers only the largest 1 % are beyond it.
double usefulLargest(const lab::Image& test, const lab::Image& truth, const ComparedPixels& pixels) {
    std::vector<double> differences = largestDifferences(test, truth, pixels);
    double largest = percentileOf(differences, 99);
    if (largest == 0.0) largest = *std::max_element(differences.begin(), differences.end());
    return largest == 0.0 ? 1.0 : roundedUp(largest);
}

Rgb colorOf(PixelState state, double difference, double largest) {
    if (state == PixelState::maskedOut) return maskedOutColor;
    return state == PixelState::notFinite ? notFiniteColor : viridis(difference / largest);
}

Result<lab::Picture> paint(const lab::Image& test, const lab::Image& truth, const CompareOptions& options,
                           std::optional<double> wanted) {
    const auto pixels = classifyPixels(test, truth, options.mask);
    if (!pixels) return pixels.error();
    const double largest = wanted ? *wanted : usefulLargest(test, truth, *pixels);
    lab::Picture picture{test.width, test.height, {}};
    picture.rgb.reserve(pixels->states.size() * 3);
    const size_t channels = size_t(test.channels);
    for (size_t i = 0; i < pixels->states.size(); ++i) {
        const double difference =
            largestDifference(&test.data[i * channels], &truth.data[i * channels], test.channels);
        const Rgb color = colorOf(pixels->states[i], difference, largest);
        picture.rgb.insert(picture.rgb.end(), color.begin(), color.end());
    }
    return withColorBar(picture, largest);
}

} // namespace

Result<lab::Picture> errorPicture(const lab::Image& test, const lab::Image& truth,
                                  const CompareOptions& options, std::optional<double> largest) {
    if (largest && !(*largest > 0.0 && std::isfinite(*largest)))
        return invalidArgument("the largest difference to show is " + std::to_string(*largest) +
                               "; a finite number above 0 was expected");
    try {
        return paint(test, truth, options, largest);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "there is not enough memory to show the error"};
    }
}

} // namespace rebound::metrics
