// SPDX-License-Identifier: MIT
// How much of a technique's error has which cause, by switching one after the other to truth.
#pragma once

#include "lab/light/path_tracer.hpp"
#include "lab/techniques/technique.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rebound::explain {

struct ExplainOptions {
    const techniques::Technique* technique = &techniques::all().front();
    techniques::Draft draft; // of its settings
    Extent2D extent{320, 180};
    int bounces = 8;   // of the truth, 1 to 64
    int samples = 256; // paths a pixel for the truth and for what the screen shows of it
    int threads = 0;   // 0: one a core
    lab::Progress progress = {};
};

struct Cause {
    std::string name;
    std::string meaning;   // what was switched from what to what
    lab::Image difference; // E / pi before the switch minus after it: what this cause adds to the result
    // All relative to the truth's mean, over all channels of pixels that see a surface.
    double bias = 0.0; // mean of the difference; the causes' add up to the whole's
    double rms = 0.0;  // of the difference alone
    // Share of the whole error that this cause is along: mean(difference * whole) / rms of the whole. Those
    // of all causes add up to the whole's rms; one that offsets others is negative.
    double part = 0.0;
};

struct Explanation {
    std::vector<Cause> causes; // in the order in which they were switched
    Cause whole;               // the technique's result minus the truth
    lab::Image result;         // of the technique: E / pi
    lab::Image truth;
    double truthMean = 0.0; // [W m^-2 sr^-1]
    // What is left to a method that computes all of what the screen shows without error: light that met
    // nothing else, minus all light. Only errors that offset each other can bring a method nearer to the
    // truth. Of techniques that know the screen alone.
    std::optional<Cause> screenLimit;
    double noise =
        0.0; // standard error of the truth's luminance, root mean square over the truth's mean; at most
};

// Runs the technique on the CPU in single precision. Fails where an option is out of its range.
Result<Explanation> explainError(const lab::Scene&, const lab::CameraView&, const ExplainOptions&);

} // namespace rebound::explain
