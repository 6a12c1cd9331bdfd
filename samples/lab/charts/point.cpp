// SPDX-License-Identifier: MIT
#include "lab/charts/point.hpp"

#include "lab/files/json_reader.hpp"

#include <cmath>
#include <limits>

namespace rebound::charts {

namespace {

using lab::checkKeys;
using lab::integerOf;
using lab::member;
using lab::numberOf;
using lab::refuseValue;
using lab::textOf;

constexpr double longest = 1e9; // a frame that takes more is an error [ms]

using metrics::ErrorMetrics;

struct NamedMetric {
    const char* name;
    double ErrorMetrics::*value;
};

constexpr NamedMetric metricNames[] = {{"mean", &ErrorMetrics::mean},
                                       {"truth_mean", &ErrorMetrics::truthMean},
                                       {"rmse", &ErrorMetrics::rmse},
                                       {"relative_rmse", &ErrorMetrics::relativeRmse},
                                       {"relative_rmse_error", &ErrorMetrics::relativeRmseError},
                                       {"truth_noise", &ErrorMetrics::truthNoise},
                                       {"rel_mse", &ErrorMetrics::relMse},
                                       {"smape", &ErrorMetrics::smape},
                                       {"bias", &ErrorMetrics::bias},
                                       {"percentile_95", &ErrorMetrics::percentile95},
                                       {"percentile_99", &ErrorMetrics::percentile99},
                                       {"ssim", &ErrorMetrics::ssim},
                                       {"flip", &ErrorMetrics::flip}};

ErrorMetrics metricsFromJson(const nlohmann::json& json) {
    ErrorMetrics metrics;
    constexpr double most = std::numeric_limits<double>::max();
    metrics.pixels = size_t(numberOf(json.at("pixels"), "metrics.pixels", 0.0, 1e12));
    metrics.notFinite = size_t(numberOf(json.at("not_finite"), "metrics.not_finite", 0.0, 1e12));
    for (const NamedMetric& metric : metricNames) {
        const nlohmann::json& value = json.at(metric.name); // null: not a number, as over a truth of 0
        metrics.*metric.value = value.is_null()
                                    ? std::numeric_limits<double>::quiet_NaN()
                                    : numberOf(value, std::string("metrics.") + metric.name, -most, most);
    }
    return metrics;
}

} // namespace

Json toJson(const Times& times) {
    return {{"median", times.median},
            {"minimum", times.minimum},
            {"p10", times.percentile10},
            {"p90", times.percentile90},
            {"frames", times.frames}};
}

Json toJson(const ErrorMetrics& metrics) {
    Json json = {{"pixels", metrics.pixels}, {"not_finite", metrics.notFinite}};
    for (const NamedMetric& metric : metricNames) {
        const double value = metrics.*metric.value;
        json[metric.name] = std::isnan(value) ? Json(nullptr) : Json(value); // as a file has it
    }
    return json;
}

Json toJson(const Point& point) {
    return {{"technique", point.technique},   {"name", point.name},
            {"settings", point.settings},     {"view", point.view},
            {"backend", point.backend},       {"device", point.device},
            {"machine", point.machine},       {"peer", point.isPeer},
            {"time_ms", toJson(point.times)}, {"metrics", toJson(point.metrics)},
            {"picture", point.picture}};
}

Json toJson(const Results& results) {
    Json json = {{"format", resultsFormat},    {"version", results.version},
                 {"machine", results.machine}, {"size", {results.size.width, results.size.height}},
                 {"bounces", results.bounces}, {"sweep", results.sweep},
                 {"views", Json::array()},     {"points", Json::array()}};
    for (const ViewRecord& view : results.views)
        json["views"].push_back({{"view", view.label},
                                 {"scene", view.scene},
                                 {"camera", view.camera},
                                 {"reference_samples", view.samples},
                                 {"reference_error", view.referenceError},
                                 {"error_scale", view.errorScale},
                                 {"picture", view.picture}});
    for (const Point& point : results.points) json["points"].push_back(toJson(point));
    return json;
}

Times timesFromJson(const nlohmann::json& json, const std::string& where) {
    checkKeys(json, where, {"median", "minimum", "p10", "p90", "frames"});
    constexpr double shortest = 1e-6;
    const auto read = [&](const char* key, double otherwise) {
        return json.contains(key) ? numberOf(json[key], where + "." + key, shortest, longest) : otherwise;
    };
    Times times;
    times.median = numberOf(member(json, "median", where + ".median"), where + ".median", shortest, longest);
    times.percentile10 = read("p10", times.median);
    times.percentile90 = read("p90", times.median);
    times.minimum = read("minimum", times.percentile10);
    if (json.contains("frames")) times.frames = integerOf(json["frames"], where + ".frames", 0, 1000000000);
    if (!(times.minimum <= times.percentile10 && times.percentile10 <= times.median &&
          times.median <= times.percentile90))
        refuseValue(where, json, "minimum <= p10 <= median <= p90");
    return times;
}

Point pointFromJson(const nlohmann::json& json) {
    Point point;
    point.technique = textOf(json.at("technique"), "technique");
    point.name = textOf(json.at("name"), "name");
    point.settings = json.at("settings");
    point.view = textOf(json.at("view"), "view");
    point.backend = textOf(json.at("backend"), "backend");
    point.device = textOf(json.at("device"), "device");
    point.machine = textOf(json.at("machine"), "machine");
    point.times = timesFromJson(json.at("time_ms"), "time_ms");
    point.metrics = metricsFromJson(json.at("metrics"));
    point.picture = textOf(json.at("picture"), "picture");
    return point;
}

} // namespace rebound::charts
