// SPDX-License-Identifier: MIT
// What is shown of a view, and how pictures of it are held against its truth.
#pragma once

#include "lab/charts/point_store.hpp"
#include "lab/charts/workshop.hpp"
#include "lab/metrics/metrics.hpp"

#include <string>

namespace rebound::charts {

// All pictures of a view have the tone curve of its truth, and all error pictures one scale.
class ViewPictures {
public:
    explicit ViewPictures(Truth);

    // Where the error pictures' colours end: the truth's mean, rounded up to 1, 2 or 5 times a power of ten.
    double errorScale() const { return scale; }

    // Over the pixels that show a surface.
    Result<metrics::ErrorMetrics> compare(const lab::Image& light) const;

    // Precondition: compare() has succeeded.
    Result<PointPictures> show(lab::Image light) const;

    // Truth and direct light, then each of these and its error, under captions.
    struct Captioned {
        std::string caption;
        lab::Image light;
    };
    Result<lab::Picture> sheet(const std::vector<Captioned>&) const;

    // The truth as <base>.png and, for the page, <base>-small.png; direct light as <base>-direct.png.
    Result<> writeView(const std::string& base) const;

private:
    metrics::CompareOptions options() const;

    Truth truth;
    lab::ToneCurve curve;
    double scale = 1.0;
    int factor = 1; // by which the page's pictures are smaller
};

// 1, 2 or 5 times a power of ten, not below the value; 1 for what is not above 0.
double roundUp(double value);

} // namespace rebound::charts
