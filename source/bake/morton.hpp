// SPDX-License-Identifier: MIT
// Places in space along a line that keeps neighbours together.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace rebound::detail {

// Bits of x, y and z in turn, z highest, of 21 bits each: the order of the Z curve. `place`: 0 to 1 along each axis.
inline uint64_t mortonCode(glm::dvec3 place) {
    uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        auto bits = uint64_t(glm::clamp(place[axis], 0.0, 1.0) * double((1u << 21) - 1));
        bits = (bits | bits << 32) & 0x001f00000000ffffull;
        bits = (bits | bits << 16) & 0x001f0000ff0000ffull;
        bits = (bits | bits << 8) & 0x100f00f00f00f00full;
        bits = (bits | bits << 4) & 0x10c30c30c30c30c3ull;
        bits = (bits | bits << 2) & 0x1249249249249249ull;
        code |= bits << axis;
    }
    return code;
}

} // namespace rebound::detail
