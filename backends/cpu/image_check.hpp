// SPDX-License-Identifier: MIT
// Whether the host's images are what a plan expects.
#pragma once

#include "rebound/cpu/device.hpp"

#include <vector>

namespace rebound::cpu {

constexpr ptrdiff_t sizeOf(Scalar s) { return s == Scalar::float16 ? 2 : 4; }

// images: by resource, null for those that are not the host's.
Result<> checkImages(const Plan&, const std::vector<const Image*>& images);

} // namespace rebound::cpu
