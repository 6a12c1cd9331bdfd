// SPDX-License-Identifier: MIT
// Points as the charts and the report take them: by view, by group, and over all views.
#pragma once

#include "lab/charts/pareto.hpp"
#include "lab/charts/point.hpp"

#include <string>
#include <vector>

namespace rebound::charts {

// One setting of one group, in one view or over all.
struct ChartPoint {
    std::string name;
    std::string technique;
    std::string group;
    Times times;
    double error = 0.0;         // relative RMSE
    double standardError = 0.0; // of it, by the truth's noise; NaN where that is not known
    bool isPeer = false;
    bool isOnFront = false; // of its group

    SpeedAndError place() const { return {times.median, error}; }
};

struct Chart {
    std::string title;
    std::string fileName; // without an ending
    std::vector<ChartPoint> points;
};

// One for each view, and, for more than one view, one over all in front: geometric means of times and errors of the
// settings that were measured in every view. Points whose error is 0 or not finite are left out, as logarithmic axes
// have no place for them.
std::vector<Chart> chartsOf(const Results&);

// Groups in the order in which they appear.
std::vector<std::string> groupsOf(const std::vector<ChartPoint>&);

// Settings that others of their group beat in every view, and the one that beats them in most.
struct Dominated {
    std::string name;
    std::string group;
    std::string by;
    size_t viewsOfThat = 0;
    size_t views = 0;
};
std::vector<Dominated> dominatedEverywhere(const Results&);

} // namespace rebound::charts
