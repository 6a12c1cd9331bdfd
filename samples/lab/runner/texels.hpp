// SPDX-License-Identifier: MIT
// Images as GPUs take them: rows of texels in a plan's format.
#pragma once

#include "lab/images/image.hpp"
#include "rebound/plan.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rebound::runner {

// The largest finite value of half precision.
inline constexpr float largestHalf = 65504.0f;

// The nearest half, beyond their range the largest; NaN stays.
uint16_t halfOf(float);
// What half precision makes of a value.
float roundToHalf(float);

// Channels that the image lacks are 0, those that the format lacks are dropped; halves as halfOf() has them.
std::vector<std::byte> texelsOf(const lab::Image&, Format);

// texels: as many as the extent has. The format's first channels.
lab::Image imageOf(const std::byte* texels, Format, Extent2D, int channels);

// Values as the format stores them.
void roundTo(Format, lab::Image&);

} // namespace rebound::runner
