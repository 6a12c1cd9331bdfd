// SPDX-License-Identifier: MIT
// A chart's measurements, one after the other, and taken up again after an interruption.
#pragma once

#include "lab/charts/peers.hpp"
#include "lab/charts/point_store.hpp"
#include "lab/charts/workshop.hpp"

#include <functional>

namespace rebound::charts {

// Called with what is done now and the share of all that is done, 0 to 1; from any thread, one call at a time.
using ChartProgress = std::function<void(const std::string&, double)>;

struct ChartRun {
    const Sweep& sweep;
    const std::vector<View>& views;
    std::vector<ChartBackend>& backends;
    const std::vector<Peer>& peers;
    std::string machine;
    std::string precision;
    ChartProgress progress = {};
};

// Each view's reference, then each setting on each backend, but for points that the store has already.
Result<Results> runChart(const ChartRun&, Workshop&, PointStore&);

} // namespace rebound::charts
