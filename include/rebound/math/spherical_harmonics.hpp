// SPDX-License-Identifier: MIT
// The formulas of spherical_harmonics.h for host code: the same text, with a number as its Real. Not for kernels.
#pragma once

#include <glm/glm.hpp>

namespace rebound::host {

using Real = float;
using Vec3 = glm::vec3;
#define RB_FUNCTION inline
#define RB_UNROLL
#include "rebound/math/spherical_harmonics.h"
#undef RB_FUNCTION
#undef RB_UNROLL

} // namespace rebound::host
