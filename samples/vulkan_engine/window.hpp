// SPDX-License-Identifier: MIT
// A window with an orbit camera.
#pragma once

#include "lab/engine/command_line.hpp"
#include "lab/engine/orbit.hpp"
#include "lab/host/vulkan_context.hpp"
#include "lab/scenes/scene.hpp"

#include <memory>

struct GLFWwindow;

namespace rebound::engine {

class Window {
public:
    // Adds the extensions that a window needs to what a context is to be made with.
    static Result<std::unique_ptr<Window>> create(Extent2D, host::VulkanOptions&);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    // Until it is closed, or as many frames have been shown as the options say. Drag to turn around the camera's target,
    // scroll to approach.
    Result<> show(const Options&, const host::VulkanContext&, const lab::Scene&, const lab::CameraView&);

private:
    Window() = default;
    Extent2D pixels() const; // 0 x 0 while it is minimised
    GLFWwindow* handle = nullptr;
    Orbit orbit;
};

} // namespace rebound::engine
