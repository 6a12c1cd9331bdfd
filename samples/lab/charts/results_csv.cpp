// SPDX-License-Identifier: MIT
#include "lab/charts/report.hpp"

#include <algorithm>

namespace rebound::charts {

namespace {

std::string textOf(const Json& value) {
    return value.is_string() ? value.get<std::string>()
                             : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string field = "\"";
    for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + "\"";
}

std::string resultsCsv(const Results& results) {
    std::string text;
    const auto add = [&](const std::string& field, bool isLast = false) {
        text += csvField(field) + (isLast ? "\r\n" : ",");
    };
    const Json metrics = toJson(metrics::ErrorMetrics{}), times = toJson(Times{});
    for (const char* name : {"view", "scene", "camera", "width", "height", "technique", "name", "settings",
                             "backend", "device", "machine", "peer"})
        add(name);
    for (const auto& [key, value] : times.items()) add(key == "frames" ? key : key + "_ms");
    for (const auto& [key, value] : metrics.items()) add(key);
    add("picture", true);
    for (const Point& point : results.points) {
        const auto view = std::find_if(results.views.begin(), results.views.end(),
                                       [&](const ViewRecord& v) { return v.label == point.view; });
        add(point.view);
        add(view == results.views.end() ? "" : view->scene);
        add(view == results.views.end() ? "" : view->camera);
        add(std::to_string(results.size.width));
        add(std::to_string(results.size.height));
        add(point.technique);
        add(point.name);
        add(textOf(point.settings));
        add(point.backend);
        add(point.device);
        add(point.machine);
        add(point.isPeer ? "true" : "false");
        for (const Json& value : toJson(point.times)) add(textOf(value));
        for (const Json& value : toJson(point.metrics)) add(textOf(value));
        add(point.picture, true);
    }
    return text;
}

} // namespace rebound::charts
