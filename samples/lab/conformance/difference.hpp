// SPDX-License-Identifier: MIT
// How far two backends' images of one pass lie apart.
#pragma once

#include "lab/conformance/tolerances.hpp"
#include "lab/images/image.hpp"
#include "rebound/plan.hpp"

#include <cstddef>
#include <vector>

namespace rebound::conformance {

// The share of a pass's texels that may rest on another decision, for each that they rest on: which of four texels lends a
// coarser one its place. Where a plane is seen at a degree, candidates score alike to within rounding, in one texel of 50
// measured.
inline constexpr double allowedDecisions = 0.03;

struct Difference {
    double maximumAbsolute = 0;
    double maximumRelative = 0; // of magnitudes above the absolute tolerance
    double maximumUlp = 0;      // in the format's last places, likewise
    size_t texels = 0;
    int choices = 1;      // that each texel rests on
    size_t beyond = 0;    // texels with a channel beyond its tolerance
    size_t decisions = 0; // texels that rest on another decision, not among those beyond
    int worstX = -1, worstY = -1, worstChannel = -1;
    float worstReference = 0, worstValue = 0;
    double worstExcess = 0; // difference over tolerance, of the worst

    bool agrees() const {
        return beyond == 0 && double(decisions) <= allowedDecisions * double(choices) * double(texels) + 1;
    }
};

// Images of one size that one pass wrote, in the order of its bindings: a decision shows in all of them.
struct PassImages {
    Format format;
    const ImageTolerance* tolerance;
    const lab::Image* reference;
    const lab::Image* value;
};
std::vector<Difference> compare(const std::vector<PassImages>&);

// Keeps the larger figures of both.
void merge(Difference& into, const Difference&);

} // namespace rebound::conformance
