// SPDX-License-Identifier: MIT
// A window with an orbit camera.
#pragma once

#include "lab/engine/command_line.hpp"

namespace rebound::engine {

// Until it is closed, or as many frames have been shown as the options say. Drag to turn around the camera's target,
// scroll to approach.
Result<> showWindow(const Options&, const lab::Scene&, const lab::CameraView&);

} // namespace rebound::engine
