// SPDX-License-Identifier: MIT
// One value a pixel, in double precision: what filters work on.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace rebound::metrics {

struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values; // row by row, from the top

    Plane() = default;
    Plane(int w, int h, double value = 0.0) : width(w), height(h), values(size_t(w) * size_t(h), value) {}

    double* row(int y) { return values.data() + size_t(y) * size_t(width); }
    const double* row(int y) const { return values.data() + size_t(y) * size_t(width); }
};

// Three of one size; what they mean is said where they are used.
using ColorPlanes = std::array<Plane, 3>;

} // namespace rebound::metrics
