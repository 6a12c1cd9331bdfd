// SPDX-License-Identifier: MIT
#include "lab/charts/fronts.hpp"

#include "lab/charts/point_store.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace rebound::charts {

namespace {

bool isDrawable(const Point& point) {
    return std::isfinite(point.metrics.relativeRmse) && point.metrics.relativeRmse > 0.0 &&
           point.times.median > 0.0;
}

ChartPoint chartPoint(const Point& point) {
    return {point.name,
            point.technique,
            point.group(),
            point.times,
            point.metrics.relativeRmse,
            point.metrics.relativeRmseError,
            point.isPeer,
            false};
}

void markFronts(Chart& chart) {
    for (const std::string& group : groupsOf(chart.points)) {
        std::vector<size_t> members;
        std::vector<SpeedAndError> places;
        for (size_t i = 0; i < chart.points.size(); ++i)
            if (chart.points[i].group == group) {
                members.push_back(i);
                places.push_back(chart.points[i].place());
            }
        for (const size_t i : paretoFront(places)) chart.points[members[i]].isOnFront = true;
    }
}

// By group and setting, in the order of their first appearance.
std::vector<std::vector<const Point*>> bySetting(const Results& results) {
    std::vector<std::vector<const Point*>> settings;
    std::map<std::pair<std::string, std::string>, size_t> index;
    for (const Point& point : results.points) {
        const auto [place, isNew] =
            index.emplace(std::pair(point.group(), point.technique + " " + point.name), settings.size());
        if (isNew) settings.emplace_back();
        settings[place->second].push_back(&point);
    }
    return settings;
}

ChartPoint meanOf(const std::vector<const Point*>& points) {
    const auto mean = [&](auto valueOf) {
        std::vector<double> values;
        for (const Point* point : points) values.push_back(valueOf(*point));
        return geometricMean(values);
    };
    ChartPoint result = chartPoint(*points.front());
    result.times.median = mean([](const Point& p) { return p.times.median; });
    result.times.minimum = mean([](const Point& p) { return p.times.minimum; });
    result.times.percentile10 = mean([](const Point& p) { return p.times.percentile10; });
    result.times.percentile90 = mean([](const Point& p) { return p.times.percentile90; });
    result.error = mean([](const Point& p) { return p.metrics.relativeRmse; });
    // Of a geometric mean of independent errors.
    double relative = 0.0;
    for (const Point* p : points)
        relative += std::pow(p->metrics.relativeRmseError / p->metrics.relativeRmse, 2.0);
    result.standardError = result.error * std::sqrt(relative) / double(points.size());
    return result;
}

bool areInEveryView(const std::vector<const Point*>& points, size_t views) {
    std::set<std::string> seen;
    for (const Point* point : points)
        if (isDrawable(*point)) seen.insert(point->view);
    return seen.size() == views && points.size() == views;
}

} // namespace

std::vector<std::string> groupsOf(const std::vector<ChartPoint>& points) {
    std::vector<std::string> groups;
    for (const ChartPoint& point : points)
        if (std::find(groups.begin(), groups.end(), point.group) == groups.end())
            groups.push_back(point.group);
    return groups;
}

std::vector<Chart> chartsOf(const Results& results) {
    std::vector<Chart> charts;
    if (results.views.size() > 1) {
        Chart all{"all " + std::to_string(results.views.size()) + " views, geometric means", "chart", {}};
        for (const auto& points : bySetting(results))
            if (areInEveryView(points, results.views.size())) all.points.push_back(meanOf(points));
        charts.push_back(std::move(all));
    }
    for (const ViewRecord& view : results.views) {
        Chart chart{view.label, "chart-" + fileNameOf(view.label), {}};
        for (const Point& point : results.points)
            if (point.view == view.label && isDrawable(point)) chart.points.push_back(chartPoint(point));
        charts.push_back(std::move(chart));
    }
    for (Chart& chart : charts) markFronts(chart);
    return charts;
}

std::vector<Dominated> dominatedEverywhere(const Results& results) {
    std::map<std::pair<std::string, std::string>, std::vector<const Point*>> rivals; // by view and group
    for (const Point& point : results.points) rivals[{point.view, point.group()}].push_back(&point);
    const auto place = [](const Point& p) { return SpeedAndError{p.times.median, p.metrics.relativeRmse}; };
    std::vector<Dominated> all;
    for (const auto& points : bySetting(results)) {
        std::map<std::string, size_t> winners; // and in how many views they win
        size_t lost = 0;
        for (const Point* point : points) {
            bool isBeaten = false;
            for (const Point* rival : rivals[{point->view, point->group()}])
                if (dominates(place(*rival), place(*point))) {
                    ++winners[rival->name];
                    isBeaten = true;
                }
            lost += isBeaten;
        }
        if (lost < points.size()) continue;
        const auto most = std::max_element(winners.begin(), winners.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        all.push_back(
            {points.front()->name, points.front()->group(), most->first, most->second, points.size()});
    }
    return all;
}

} // namespace rebound::charts
