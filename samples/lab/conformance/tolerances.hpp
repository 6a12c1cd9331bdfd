// SPDX-License-Identifier: MIT
// How far backends may lie apart: a property of images, by what they hold and in which format.
#pragma once

#include "rebound/plan.hpp"

#include <array>
#include <vector>

namespace rebound::conformance {

// A channel agrees where |a - b| <= relative * magnitude + absolute.
struct Tolerance {
    double relative = 0;
    double absolute = 0;
    const char* reason = "";
};

struct ImageTolerance {
    std::array<Tolerance, 4> channels{};
    bool isVector = false; // the first three channels are a vector, held against its length
    // Its texels rest on a choice among finer ones: where the vector's length agrees and another value does not, another
    // one was chosen, for all images of the pass.
    bool isChosen = false;
    int choices = 1; // that a chosen texel rests on, one after the other
};

// Of an image or a buffer of numbers of that format, of which nothing else is known.
ImageTolerance toleranceOf(Format);

// By resource, of a plan of one of the lab's techniques; largestRadiance: of its inputs.
std::vector<ImageTolerance> techniqueTolerances(const Plan&, float largestRadiance);

} // namespace rebound::conformance
