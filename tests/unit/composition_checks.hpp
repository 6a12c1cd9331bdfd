// SPDX-License-Identifier: MIT
// Frames of composition with pixels everywhere, and light that is known.
#pragma once

#include "composition_frame.hpp"
#include "random_bake.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace rebound::test {

// Pixels that lie everywhere in the grid and around it, and look everywhere.
inline void scatterPixels(CompositionFrames& frames, uint32_t seed) {
    Numbers32 random(seed);
    for (int y = 0; y < frames.settings.resolution.height; ++y)
        for (int x = 0; x < frames.settings.resolution.width; ++x) {
            frames.depth.at(x, y, 0) = random.within(0.05f, 9.0f);
            const glm::vec3 n = random.direction();
            for (int c = 0; c < 3; ++c) frames.normal.at(x, y, c) = n[c];
        }
}

inline void checkEverywhere(const CompositionFrames& frames, glm::vec3 expected, double tolerance) {
    double worst = 0.0;
    for (size_t i = 0; i < frames.indirect.values.size(); ++i)
        worst = std::max(worst, std::abs(double(frames.indirect.values[i]) - double(expected[int(i % 3)])));
    CHECK(worst <= tolerance);
}

// Roundings of some dozen products in single precision, and reciprocals to 5e-7.
inline constexpr double single = 1e-5;

} // namespace rebound::test
