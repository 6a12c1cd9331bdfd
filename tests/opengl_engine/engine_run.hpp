// SPDX-License-Identifier: MIT
// The engine's renderer without a window, with debug output on.
#pragma once

#include "../engine/pictures.hpp"

#include "lab/host/opengl_context.hpp"
#include "lab/scenes/scene_files.hpp"
#include "opengl_engine/renderer.hpp"

#include <memory>

namespace rebound::engine {

inline host::OpenGLContext openContext() {
    return require(host::OpenGLContext::create(host::OpenGLApi::desktop));
}

inline void checkSilence(host::OpenGLContext& context) {
    for (const std::string& message : context.takeMessages()) FAIL_CHECK(message);
    require(checkErrors("in the test"));
}

inline std::unique_ptr<Renderer> rendererFor(const lab::Scene& scene, Extent2D size,
                                             const lab::CameraView& view,
                                             const std::string& preset = "quarter-64") {
    auto renderer = require(Renderer::create(host::OpenGLContext::functionNamed, scene, preset));
    require(renderer->resize(size, view));
    return renderer;
}

} // namespace rebound::engine
