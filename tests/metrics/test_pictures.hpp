// SPDX-License-Identifier: MIT
// Pictures from formulas.
#pragma once

#include "lab/metrics/metrics.hpp"
#include "lab/metrics/plane.hpp"

#include <doctest/doctest.h>

#include <initializer_list>

namespace rebound::metrics {

// One row.
inline lab::Image rowOf(std::initializer_list<float> values, int channels = 1) {
    lab::Image image({int(values.size()) / channels, 1}, channels);
    image.data = values;
    return image;
}

// value(x, y, channel) at each pixel.
template <class Value>
lab::Image imageOf(Extent2D extent, int channels, const Value& value) {
    lab::Image image(extent, channels);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y)[c] = float(value(x, y, c));
    return image;
}

template <class Value>
Plane planeOf(int width, int height, const Value& value) {
    Plane plane(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) plane.row(y)[x] = value(x, y);
    return plane;
}

inline double meanOf(const Plane& plane) {
    double sum = 0.0;
    for (const double value : plane.values) sum += value;
    return sum / double(plane.values.size());
}

inline ErrorMetrics compared(const lab::Image& test, const lab::Image& truth,
                             const CompareOptions& options = {}) {
    const auto metrics = compareImages(test, truth, options);
    REQUIRE_MESSAGE(metrics, (metrics ? "" : metrics.error().message));
    return *metrics;
}

} // namespace rebound::metrics
