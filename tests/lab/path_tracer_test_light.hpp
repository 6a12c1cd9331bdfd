// SPDX-License-Identifier: MIT
// What tests of path-traced light share.
#pragma once

#include "lab/light/path_tracer.hpp"

#include "frame_test_scene.hpp"

namespace rebound::lab {

inline PathTracedLight traced(const Scene& scene, const CameraView& camera,
                              const PathTracerOptions& options) {
    auto light = tracePaths(scene, camera, options);
    REQUIRE_MESSAGE(light, (light ? "" : light.error().message));
    return *std::move(light);
}

// Over all pixels, of the red channel.
inline double meanOf(const Image& image) {
    double sum = 0.0;
    for (size_t i = 0; i < image.data.size(); i += size_t(image.channels)) sum += double(image.data[i]);
    return sum / (double(image.width) * double(image.height));
}

// Of the mean over all pixels, whose paths are independent.
inline double standardErrorOfMean(const PathTracedLight& light) {
    double sum = 0.0;
    for (const float error : light.standardError.data) sum += double(error) * double(error);
    return std::sqrt(sum) / double(light.standardError.data.size());
}

// A mean differs from the truth by more than 4.5 standard errors once in 100,000 times; float rounding of
// sums and of ray directions stays below 1e-4 of the value.
inline double allowedDifference(const PathTracedLight& light, double truth) {
    return 4.5 * standardErrorOfMean(light) + 1e-4 * truth;
}

} // namespace rebound::lab
