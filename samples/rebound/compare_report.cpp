// SPDX-License-Identifier: MIT
#include "compare_report.hpp"

#include <cmath>

namespace rebound::cli {

namespace {

struct Measure {
    const char* name; // in the table
    const char* key;  // in JSON
    double metrics::ErrorMetrics::*value;
    const char* meaning;
};

using metrics::ErrorMetrics;
constexpr Measure measures[] = {
    {"mean", "mean", &ErrorMetrics::mean, "of the picture under test"},
    {"truth mean", "truth_mean", &ErrorMetrics::truthMean, "of the truth"},
    {"bias", "bias", &ErrorMetrics::bias, "mean difference; below 0: too dark"},
    {"RMSE", "rmse", &ErrorMetrics::rmse, "root of the mean squared difference"},
    {"relative RMSE", "relative_rmse", &ErrorMetrics::relativeRmse, "RMSE over the truth's mean"},
    {"standard error", "relative_rmse_error", &ErrorMetrics::relativeRmseError,
     "of the relative RMSE, by the noise of the truth's halves"},
    {"truth noise", "truth_noise", &ErrorMetrics::truthNoise,
     "of the truth over its mean; taken out of both RMSE, not of the others"},
    {"pattern", "pattern", &ErrorMetrics::pattern,
     "standard deviation of the difference's 8x8 means on smooth surfaces, over the truth there"},
    {"relMSE", "rel_mse", &ErrorMetrics::relMse,
     "mean squared difference over the truth's square at each pixel"},
    {"SMAPE", "smape", &ErrorMetrics::smape, "mean difference over the mean of both at each pixel, 0 to 2"},
    {"95th percentile", "percentile_95", &ErrorMetrics::percentile95,
     "difference that 95 % of the pixels do not exceed"},
    {"99th percentile", "percentile_99", &ErrorMetrics::percentile99,
     "difference that 99 % of the pixels do not exceed"},
    {"SSIM", "ssim", &ErrorMetrics::ssim, "similarity of structure as displayed; 1: the same"},
    {"FLIP", "flip", &ErrorMetrics::flip,
     "what an observer sees of the difference as displayed, 0: nothing, to 1"},
};

std::string leftOut(const Comparison& c) {
    std::string text = std::to_string(c.metrics.pixels) + " pixels compared";
    if (c.mask) text += ", " + std::to_string(c.metrics.maskedOut) + " masked out";
    text += ", " + std::to_string(c.metrics.notFinite) + " left out as not finite";
    if (c.metrics.notFinite > 0)
        text += " (" + std::to_string(c.metrics.notFiniteInTest) + " in " + c.test + ", " +
                std::to_string(c.metrics.notFiniteInTruth) + " in " + c.truth + ")";
    if (c.surfaces)
        text +=
            "; " + std::to_string(c.metrics.smoothBlocks) + " blocks on smooth surfaces of " + *c.surfaces;
    return text;
}

} // namespace

std::string compareText(const Comparison& c) {
    std::string text = c.test + " against " + c.truth + (c.otherHalf ? " and " + *c.otherHalf : "") + ", " +
                       std::to_string(c.extent.width) + "x" + std::to_string(c.extent.height) + "\n" +
                       leftOut(c) + "\n\n" + formatted("%-16s %12s  %s\n", "measure", "value", "meaning");
    for (const Measure& measure : measures) {
        const double value = c.metrics.*measure.value;
        const std::string shown = std::isnan(value) ? "-" : formatted("%.6g", value);
        text += formatted("%-16s %12s  %s\n", measure.name, shown.c_str(), measure.meaning);
    }
    return text +
           formatted("\nexposure %.6g, then 1 - exp(-x) and sRGB, for SSIM and FLIP; %g pixels per degree\n",
                     double(c.curve.exposure), c.pixelsPerDegree);
}

Json compareJson(const Comparison& c) {
    Json json;
    json["test"] = c.test;
    json["truth"] = c.truth;
    json["truth_b"] = c.otherHalf ? Json(*c.otherHalf) : Json(nullptr);
    json["mask"] = c.mask ? Json(*c.mask) : Json(nullptr);
    json["surfaces"] = c.surfaces ? Json(*c.surfaces) : Json(nullptr);
    json["resolution"] = {c.extent.width, c.extent.height};
    json["channels"] = c.channels;
    json["exposure"] = c.curve.exposure;
    json["pixels_per_degree"] = c.pixelsPerDegree;
    json["pixels"] = c.metrics.pixels;
    json["masked_out"] = c.metrics.maskedOut;
    json["not_finite"] = c.metrics.notFinite;
    json["not_finite_in_test"] = c.metrics.notFiniteInTest;
    json["not_finite_in_truth"] = c.metrics.notFiniteInTruth;
    json["smooth_blocks"] = c.surfaces ? Json(c.metrics.smoothBlocks) : Json(nullptr);
    for (const Measure& measure : measures) {
        const double value = c.metrics.*measure.value;
        json[measure.key] = std::isnan(value) ? Json(nullptr) : Json(value);
    }
    return json;
}

} // namespace rebound::cli
