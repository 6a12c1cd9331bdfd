// SPDX-License-Identifier: MIT
#include "lab/charts/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rebound::charts {

bool dominates(const SpeedAndError& better, const SpeedAndError& worse) {
    const bool noWorse = better.milliseconds <= worse.milliseconds && better.error <= worse.error;
    return noWorse && (better.milliseconds < worse.milliseconds || better.error < worse.error);
}

std::vector<size_t> paretoFront(const std::vector<SpeedAndError>& points) {
    std::vector<size_t> order;
    for (size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].milliseconds) && std::isfinite(points[i].error)) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        const SpeedAndError &p = points[a], &q = points[b];
        return p.milliseconds != q.milliseconds ? p.milliseconds < q.milliseconds : p.error < q.error;
    });
    std::vector<size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const size_t i : order) {
        const bool equalsLast = !front.empty() && points[i].error == least &&
                                points[i].milliseconds == points[front.back()].milliseconds;
        if (points[i].error < least || equalsLast) front.push_back(i);
        least = std::min(least, points[i].error);
    }
    return front;
}

double geometricMean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += std::log(value);
    return std::exp(sum / double(values.size()));
}

} // namespace rebound::charts
