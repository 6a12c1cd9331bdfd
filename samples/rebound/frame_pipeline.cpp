// SPDX-License-Identifier: MIT
#include "frame_pipeline.hpp"

#include "options.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace rebound::cli {

namespace {

// Depth is planar, so that the planes that clip do not matter; the far one may be infinite.
glm::dmat4 projectionOf(const lab::CameraView& view, double aspect) {
    if (view.orthographic) {
        const double top = double(view.orthographicHeight) / 2.0;
        return glm::orthoRH_ZO(-top * aspect, top * aspect, -top, top, double(view.nearPlane),
                               double(view.farPlane));
    }
    return glm::infinitePerspectiveRH(double(view.verticalFieldOfView), aspect, double(view.nearPlane));
}

// The technique takes radiance up to half's largest value. Returns the number of pixels that were above.
size_t limitToRange(lab::Image& image) {
    size_t count = 0;
    for (size_t i = 0; i < image.data.size(); i += 3) {
        count += std::max({image.data[i], image.data[i + 1], image.data[i + 2]}) > largestHalf;
        for (size_t c = 0; c < 3; ++c)
            image.data[i + c] = std::min(image.data[i + c], largestHalf);
    }
    return count;
}

} // namespace

Camera cameraOf(const lab::CameraView& view, Extent2D extent) {
    Camera camera;
    camera.view =
        glm::mat4(glm::lookAtRH(glm::dvec3(view.position), glm::dvec3(view.target), glm::dvec3(view.up)));
    camera.projection = glm::mat4(projectionOf(view, double(extent.width) / double(extent.height)));
    return camera;
}

Result<FramePipeline> FramePipeline::create(const lab::Frame& frame, const ScreenIndirectSettings& requested,
                                            const cpu::Device& device, cpu::Scalar precision) {
    ScreenIndirectSettings settings = requested;
    settings.conventions.projection =
        frame.camera.orthographic ? Projection::orthographic : Projection::perspective;
    auto plan = planOf(settings);
    if (!plan)
        return plan.error();
    auto program = device.compile(*plan);
    if (!program)
        return program.error();

    FramePipeline pipeline(settings, *std::move(program));
    lab::Image outgoing = lab::outgoingRadiance(frame);
    pipeline.limited = limitToRange(outgoing);
    pipeline.depth = HostImage(frame.depth, cpu::Scalar::float32);
    pipeline.normal = HostImage(frame.normal, precision);
    pipeline.albedo = HostImage(frame.albedo, precision);
    pipeline.radiance = HostImage(outgoing, precision);
    pipeline.indirect_ = HostImage(settings.resolution, 3, precision);
    pipeline.composed_ = HostImage(settings.resolution, 3, precision);

    ScreenIndirectFrame<cpu::Image> images;
    images.camera = cameraOf(frame.camera, settings.resolution);
    images.depth = pipeline.depth.view();
    images.normal = pipeline.normal.view();
    images.albedo = pipeline.albedo.view();
    images.radiance = images.lit = pipeline.radiance.view();
    images.indirect = pipeline.indirect_.view();
    images.composed = pipeline.composed_.view();
    auto inputs = screenIndirectInputs(settings, images);
    if (!inputs)
        return inputs.error();
    pipeline.inputs = *std::move(inputs);
    return pipeline;
}

Result<double> FramePipeline::run() {
    const auto start = std::chrono::steady_clock::now();
    if (auto recorded = program.record(inputs); !recorded)
        return recorded.error();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace rebound::cli
