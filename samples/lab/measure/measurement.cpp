// SPDX-License-Identifier: MIT
#include "lab/measure/measurement.hpp"

#include <algorithm>

namespace rebound::measure {

namespace {

void add(Measurement& measurement, const std::vector<PassTiming>& timings, double frameMilliseconds) {
    if (measurement.passes.empty())
        for (const PassTiming& pass : timings) measurement.passes.push_back({pass.label, {}});
    for (size_t i = 0; i < timings.size(); ++i)
        measurement.passes[i].milliseconds.push_back(timings[i].milliseconds);
    measurement.frame.milliseconds.push_back(frameMilliseconds);
}

} // namespace

double Series::minimum() const { return *std::min_element(milliseconds.begin(), milliseconds.end()); }

double Series::percentile(double share) const {
    std::vector<double> sorted = milliseconds;
    std::sort(sorted.begin(), sorted.end());
    const double place = share / 100.0 * double(sorted.size() - 1);
    const size_t below = std::min(size_t(place), sorted.size() - 1);
    const size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - double(below)) * (sorted[above] - sorted[below]);
}

Result<Measurement> measureFrames(FramePipeline& pipeline, const MeasureOptions& options) {
    Measurement measurement;
    const int total = options.warmUp + options.frames;
    for (int i = 0; i < total; ++i) {
        const auto milliseconds = pipeline.run();
        if (!milliseconds) return milliseconds.error();
        if (i >= options.warmUp) add(measurement, pipeline.timings(), *milliseconds);
        if (const auto recording = pipeline.recordingTime(); recording && i >= options.warmUp)
            measurement.recording.milliseconds.push_back(*recording);
        if (options.progress) options.progress(double(i + 1) / double(total));
    }
    return measurement;
}

} // namespace rebound::measure
