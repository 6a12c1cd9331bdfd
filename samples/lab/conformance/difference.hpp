// SPDX-License-Identifier: MIT
// How far two backends' images of one pass lie apart.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/plan.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rebound::conformance {

// A channel agrees where |a - b| <= relative * magnitude + absolute.
struct Tolerance {
    double relative = 0;
    double absolute = 0;
    const char* reason = "";
};

// largestRadiance: of the case's inputs. Channels of a resource that a pass of that kernel writes.
Tolerance toleranceOf(const std::string& kernel, const Resource&, int channel, float largestRadiance);

// The share of a pass's texels that may rest on another decision: which of four texels lends a coarser one its place.
// Where a plane is seen at a degree, candidates score alike to within rounding, in one texel of 50 measured.
inline constexpr double allowedDecisions = 0.03;

struct Difference {
    double maximumAbsolute = 0;
    double maximumRelative = 0; // of magnitudes above the absolute tolerance
    double maximumUlp = 0;      // in the format's last places, likewise
    size_t texels = 0;
    size_t beyond = 0;    // texels with a channel beyond its tolerance
    size_t decisions = 0; // texels that rest on another decision, not among those beyond
    int worstX = -1, worstY = -1, worstChannel = -1;
    float worstReference = 0, worstValue = 0;
    double worstExcess = 0; // difference over tolerance, of the worst

    bool agrees() const { return beyond == 0 && double(decisions) <= allowedDecisions * double(texels) + 1; }
};

// Images that a pass of that kernel wrote, in the order of its bindings: a decision shows in all of them.
struct PassImages {
    const Resource* resource;
    const lab::Image* reference;
    const lab::Image* value;
};
std::vector<Difference> compare(const std::string& kernel, const std::vector<PassImages>&,
                                float largestRadiance);

// Keeps the larger figures of both.
void merge(Difference& into, const Difference&);

} // namespace rebound::conformance
