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

Result<std::vector<Measurement>> measureInTurns(const std::vector<FramePipeline*>& pipelines,
                                                const MeasureOptions& options) {
    std::vector<Measurement> measurements(pipelines.size());
    const int total = options.warmUp + options.frames;
    for (int i = 0; i < total; ++i) {
        for (size_t which = 0; which < pipelines.size(); ++which) {
            FramePipeline& pipeline = *pipelines[which];
            const auto milliseconds = pipeline.run();
            if (!milliseconds) return milliseconds.error();
            if (i < options.warmUp) continue;
            add(measurements[which], pipeline.timings(), *milliseconds);
            if (const auto recording = pipeline.recordingTime())
                measurements[which].recording.milliseconds.push_back(*recording);
        }
        if (options.progress) options.progress(double(i + 1) / double(total));
    }
    return measurements;
}

Result<Measurement> measureFrames(FramePipeline& pipeline, const MeasureOptions& options) {
    auto measurements = measureInTurns({&pipeline}, options);
    if (!measurements) return measurements.error();
    return std::move(measurements->front());
}

double ratioOf(const Measurement& measurement, const Measurement& other) {
    Series ratios{"ratio", {}};
    for (size_t i = 0; i < measurement.frame.milliseconds.size(); ++i)
        ratios.milliseconds.push_back(measurement.frame.milliseconds[i] / other.frame.milliseconds[i]);
    return ratios.median();
}

} // namespace rebound::measure
