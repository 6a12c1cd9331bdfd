// SPDX-License-Identifier: MIT
// What frames take, over many of them.
#pragma once

#include "lab/measure/frame_pipeline.hpp"

#include <string>
#include <vector>

namespace rebound::measure {

// What one pass took, or a whole frame, over all measured frames [ms].
struct Series {
    std::string name;
    std::vector<double> milliseconds;

    // Precondition of these: the series is not empty.
    double minimum() const;
    double median() const { return percentile(50.0); }
    // share: 0 to 100. Between two values in proportion: the one at share / 100 (n - 1) of the sorted series.
    double percentile(double share) const;
};

struct Measurement {
    std::vector<Series> passes;
    Series frame{"frame", {}};
    Series recording{"recording", {}}; // on the host, where a GPU does the work; else empty
};

struct MeasureOptions {
    int warmUp = 5;  // frames before those that count, at least 0
    int frames = 50; // at least 1
    lab::Progress progress = {};
};

Result<Measurement> measureFrames(FramePipeline&, const MeasureOptions&);

// Several in turns, a frame of each after the other, so that what slows the machine for a while slows all of them.
// Precondition: there is at least one.
Result<std::vector<Measurement>> measureInTurns(const std::vector<FramePipeline*>&, const MeasureOptions&);

// How much longer than the other's a frame took, at the median of frames of the same turn.
double ratioOf(const Measurement&, const Measurement& other);

} // namespace rebound::measure
