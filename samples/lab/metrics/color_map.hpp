// SPDX-License-Identifier: MIT
// Numbers as colours.
#pragma once

#include <array>

namespace rebound::metrics {

// viridis by van der Walt and Smith (Matplotlib, CC0): equal steps look equally large, also in grey and to
// colour-blind people. Values below 0 and above 1 take the colour of the nearest end.
std::array<unsigned char, 3> viridis(double value);

} // namespace rebound::metrics
