// SPDX-License-Identifier: MIT
// The engine's renderer without a window, with validation and synchronization validation on.
#pragma once

#include "lab/scene_files.hpp"
#include "vulkan_engine/renderer.hpp"

#include <doctest/doctest.h>

#include <memory>

namespace rebound::engine {

// Null, and a message that says so, where Vulkan or its validation layer is missing.
inline std::unique_ptr<host::VulkanContext> openContext() {
    host::VulkanOptions options;
    options.validation = true;
    auto context = host::VulkanContext::create(options);
    if (context) return std::make_unique<host::VulkanContext>(*std::move(context));
    MESSAGE("skipped: ", context.error().message);
    return nullptr;
}

inline void checkSilence(const host::VulkanContext& context) {
    for (const std::string& message : context.messages()) FAIL_CHECK(message);
}

template <class T>
T require(Result<T> result) {
    REQUIRE_MESSAGE(result, (result ? "" : result.error().message));
    return *std::move(result);
}
inline void require(Result<> result) { REQUIRE_MESSAGE(result, (result ? "" : result.error().message)); }

inline std::unique_ptr<Renderer> rendererFor(const host::VulkanContext& context, const lab::Scene& scene, Extent2D size,
                                             const lab::CameraView& view, const std::string& preset = "quarter-64") {
    auto renderer = require(Renderer::create(context, scene, preset));
    require(renderer->resize(size, view));
    return renderer;
}

inline void renderFrame(const host::VulkanContext& context, Renderer& renderer, int frame, const lab::CameraView& view) {
    require(context.run([&](VkCommandBuffer commands) { return renderer.record(commands, frame, view); }));
}

inline double mean(const lab::Image& image) {
    double sum = 0.0;
    for (float value : image.data) sum += double(value);
    return sum / double(image.data.size());
}

// The mean and the root mean square of differences, relative to the second image's mean.
struct Difference {
    double average = 0.0, root = 0.0, largest = 0.0;
};
inline Difference difference(const lab::Image& image, const lab::Image& expected) {
    REQUIRE(image.data.size() == expected.data.size());
    Difference d;
    const double scale = mean(expected), count = double(image.data.size());
    for (size_t i = 0; i < image.data.size(); ++i) {
        const double e = std::abs(double(image.data[i]) - double(expected.data[i])) / scale;
        d.average += e / count;
        d.root += e * e / count;
        d.largest = std::max(d.largest, e);
    }
    d.root = std::sqrt(d.root);
    return d;
}

} // namespace rebound::engine
