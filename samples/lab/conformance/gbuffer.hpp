// SPDX-License-Identifier: MIT
// Made-up G-buffers.
#pragma once

#include "lab/conformance/cases.hpp"
#include "lab/conformance/random.hpp"
#include "lab/scenes/camera_conventions.hpp"

#include <glm/glm.hpp>

namespace rebound::conformance {

struct GBuffer {
    ScreenIndirectSettings settings;
    ScreenIndirectFrame<lab::Image> frame;
};

struct GBufferOptions {
    int patches = 8;            // planes that share the screen
    double scale = 1;           // of all lengths
    double skyShare = 0.15;     // of the patches
    bool grazing = false;       // planes almost along the rays
    double radianceDecades = 3; // from 10^-d to 10^d
    double farRatio = 1;        // every other patch is so many times as far away
    bool corner = false;        // a room's: patches are its walls, each seen where it is the nearest
};

// settings: the resolution and the conventions are taken from it.
GBuffer makeGBuffer(const ScreenIndirectSettings&, const GBufferOptions&, Random&);

Result<Case> caseOf(const GBuffer&, runner::Precision);

} // namespace rebound::conformance
