// SPDX-License-Identifier: MIT
// Drawings by the program gnuplot.
#pragma once

#include "lab/charts/fronts.hpp"
#include "rebound/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rebound::charts {

// The program's path, looked for in PATH. Fails where it is not there.
Result<std::filesystem::path> findGnuplot();

// What all charts of a set have in common.
struct PlotTexts {
    std::string subtitle; // below each title
    std::string xLabel;
    std::string yLabel;
};

// Commands that draw each chart that has points to <folder>/<fileName>.svg and .png: logarithmic axes, a colour for each
// group, bars from the 10th to the 90th percentile of times, fronts as steps, the key below the axes.
std::string plotScript(const std::vector<Chart>&, const PlotTexts&, const std::filesystem::path& folder);

// Runs it. The error holds the first line that it complained with.
Result<> runGnuplot(const std::filesystem::path& program, const std::filesystem::path& script);

} // namespace rebound::charts
