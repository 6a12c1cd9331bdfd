// SPDX-License-Identifier: MIT
// The engine's renderer without a window, with debug output on.
#pragma once

#include "../engine/pictures.hpp"

#include "host/opengl_context.hpp"
#include "lab/scene_files.hpp"
#include "opengl_engine/renderer.hpp"

#include <memory>

namespace rebound::engine {

// Null, and a message that ctest takes for a skipped test, where there is no OpenGL.
inline std::unique_ptr<host::OpenGLContext> openContext() {
    auto context = host::OpenGLContext::create(host::OpenGLApi::desktop);
    if (context) return std::make_unique<host::OpenGLContext>(*std::move(context));
    MESSAGE("skipped: ", context.error().message);
    return nullptr;
}

inline void checkSilence(host::OpenGLContext& context) {
    for (const std::string& message : context.takeMessages()) FAIL_CHECK(message);
    require(checkErrors("in the test"));
}

inline std::unique_ptr<Renderer> rendererFor(const lab::Scene& scene, Extent2D size, const lab::CameraView& view,
                                             const std::string& preset = "quarter-64") {
    auto renderer = require(Renderer::create(host::OpenGLContext::functionNamed, scene, preset));
    require(renderer->resize(size, view));
    return renderer;
}

} // namespace rebound::engine
