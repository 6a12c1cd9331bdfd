// SPDX-License-Identifier: MIT
// A bar beside a picture that says which number a colour stands for.
#pragma once

#include "lab/images/image_files.hpp"

#include <vector>

namespace rebound::metrics {

// 1, 2 or 5 times a power of ten, the least that is not below the value, which is above 0.
double roundedUp(double value);

// Where a scale from 0 to `largest` has labels: multiples of a round number, and both ends.
std::vector<double> ticksUpTo(double largest);

// The picture in the upper left, and at its right a bar from 0, below, to `largest`, above.
lab::Picture withColorBar(const lab::Picture&, double largest);

} // namespace rebound::metrics
