// SPDX-License-Identifier: MIT
// The engine's camera: OpenGL's clip space, and what Rebound has to know of it.
#pragma once

#include "lab/scenes/scene.hpp"
#include "rebound/camera.hpp"

namespace rebound::engine {

// y up, normalised device depth -1 at the near plane and 1 at the far one, as gluPerspective and glOrtho have it.
Camera cameraOf(const lab::CameraView&, Extent2D);

GBufferConventions conventionsOf(const lab::CameraView&);

} // namespace rebound::engine
