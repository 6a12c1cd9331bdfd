// SPDX-License-Identifier: MIT
// What a comparison of two pictures found, for people and for programs.
#pragma once

#include "lab/metrics/metrics.hpp"
#include "report.hpp"

#include <optional>
#include <string>

namespace rebound::cli {

struct Comparison {
    std::string test, truth;              // files
    std::optional<std::string> otherHalf; // of the truth
    std::optional<std::string> mask;
    std::optional<std::string> surfaces; // a folder
    Extent2D extent;
    int channels = 0;
    lab::ToneCurve curve;
    double pixelsPerDegree = 0.0;
    metrics::ErrorMetrics metrics;
};

std::string compareText(const Comparison&);
Json compareJson(const Comparison&);

} // namespace rebound::cli
