// SPDX-License-Identifier: MIT
// The engine's camera: Vulkan's clip space, reversed depth, and what Rebound has to know of them.
#pragma once

#include "lab/scenes/scene.hpp"
#include "rebound/camera.hpp"

namespace rebound::engine {

// y down, depth 1 at the near plane and 0 far away: at infinity in perspective, at the far plane otherwise.
Camera cameraOf(const lab::CameraView&, Extent2D);

GBufferConventions conventionsOf(const lab::CameraView&);

} // namespace rebound::engine
