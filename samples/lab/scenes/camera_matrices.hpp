// SPDX-License-Identifier: MIT
// A camera of the lab as an engine hands it to Rebound.
#pragma once

#include "lab/scenes/scene.hpp"
#include "rebound/camera.hpp"

namespace rebound::lab {

// Right-handed matrices for pictures of that size. The lab's depth is planar, so that planes which clip do not matter:
// in perspective the far one is infinite.
Camera cameraMatrices(const CameraView&, Extent2D);

} // namespace rebound::lab
