// SPDX-License-Identifier: MIT
// The engine's renderer without a window, with validation and synchronization validation on.
#pragma once

#include "../engine/pictures.hpp"

#include "lab/scenes/scene_files.hpp"
#include "vulkan_engine/renderer.hpp"

#include <memory>

namespace rebound::engine {

inline host::VulkanContext openContext() {
    host::VulkanOptions options;
    options.validation = true;
    return require(host::VulkanContext::create(options));
}

inline void checkSilence(const host::VulkanContext& context) {
    for (const std::string& message : context.messages()) FAIL_CHECK(message);
}

inline std::unique_ptr<Renderer> rendererFor(const host::VulkanContext& context, const lab::Scene& scene,
                                             Extent2D size, const lab::CameraView& view,
                                             const std::string& preset = "quarter-64") {
    auto renderer = require(Renderer::create(context, scene, preset));
    require(renderer->resize(size, view));
    return renderer;
}

inline void renderFrame(const host::VulkanContext& context, Renderer& renderer, int frame,
                        const lab::CameraView& view) {
    require(context.run([&](VkCommandBuffer commands) { return renderer.record(commands, frame, view); }));
}

} // namespace rebound::engine
