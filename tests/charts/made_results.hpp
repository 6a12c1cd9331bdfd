// SPDX-License-Identifier: MIT
// Results whose figures are made up, for tests of what is drawn and written.
#pragma once

#include "lab/charts/point.hpp"

#include <string>

namespace rebound::charts {

inline Point madePoint(const std::string& view, const std::string& name, double median, double error,
                       const std::string& backend = "cpu") {
    Point point;
    point.technique = "screen_indirect";
    point.name = name;
    point.settings = {{"preset", name}, {"levels", 4}};
    point.view = view;
    point.backend = backend;
    point.device = backend == "cpu" ? "avx2 on 2 threads" : "a device";
    point.machine = "a processor, 2 cores";
    point.times = {median, 0.8 * median, 0.9 * median, 1.3 * median, 20};
    point.metrics.pixels = 1000;
    point.metrics.mean = 1.0 - 0.5 * error;
    point.metrics.truthMean = 1.0;
    point.metrics.rmse = point.metrics.relativeRmse = error;
    point.metrics.relMse = error * error;
    point.metrics.smape = error / 2.0;
    point.metrics.bias = -0.5 * error;
    point.metrics.percentile95 = 2.0 * error;
    point.metrics.percentile99 = 3.0 * error;
    point.metrics.ssim = 1.0 - error / 2.0;
    point.metrics.flip = error / 4.0;
    point.picture = "a-picture";
    return point;
}

// In both views: fast and coarse, slow and fine; middling is worse than fast in both.
inline Results madeResults() {
    Results results;
    results.version = "0.0.0";
    results.machine = "a processor, 2 cores";
    results.sweep = Json::object();
    results.size = {64, 36};
    results.views = {{"atrium nave", "builtin:atrium", "nave", 256, 0.02, 0.5, "a-view"},
                     {"cornell front", "builtin:cornell", "front", 128, 0.01, 0.2, "a-view"}};
    for (const ViewRecord& view : results.views) {
        const double scale = view.label == "atrium nave" ? 1.0 : 1.5;
        results.points.push_back(madePoint(view.label, "fast", 2.0 * scale, 0.4 * scale));
        results.points.push_back(madePoint(view.label, "middling", 3.0 * scale, 0.45 * scale));
        results.points.push_back(madePoint(view.label, "slow", 9.0 * scale, 0.1 * scale));
        results.points.push_back(madePoint(view.label, "fast", 1.0 * scale, 0.4 * scale, "vulkan"));
        results.points.push_back(madePoint(view.label, "slow", 4.0 * scale, 0.1 * scale, "vulkan"));
    }
    return results;
}

} // namespace rebound::charts
