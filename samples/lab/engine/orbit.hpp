// SPDX-License-Identifier: MIT
// A window's camera, turned by dragging and moved by scrolling.
#pragma once

#include "lab/scenes/scene.hpp"
#include "rebound/result.hpp"

struct GLFWwindow;

namespace rebound::engine {

// Turns the camera around its target.
struct Orbit {
    lab::CameraView view;
    double lastX = 0.0, lastY = 0.0; // of the cursor

    void turn(double right, double up); // [rad]
    // From now on by that window, whose user pointer it takes; it outlives the window.
    void listen(GLFWwindow*);
};

// What GLFW says of its last failure, behind the option that asked for a window.
Error windowError(const char* what);

} // namespace rebound::engine
