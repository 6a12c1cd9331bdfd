// SPDX-License-Identifier: MIT
// Frames for the input check: right in all that it looks at, until a test spoils something.
#pragma once

#include "test_scene.hpp"

#include "rebound/detail/input_check_statistics.hpp"

#include <set>

namespace rebound::test {

struct CheckFrame {
    InputCheckSettings settings;
    Camera camera, previousCamera;
    Picture depth, normal, albedo, radiance, lit, emission, motion;
};

// Turns and moves the world, so that world and view space differ in every axis.
inline const glm::mat4 tiltedWorld =
    glm::translate(glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0.3f, 1.0f, -0.2f)), glm::vec3(1, -2, 3));

// Squares of four pixels, light, middle and dark, and here and there nearly black.
inline float albedoAt(int x, int y, int channel) {
    constexpr float values[] = {0.8f, 0.3f, 0.5f, 0.15f, 0.8f, 0.005f};
    const float value = values[(x / 4 + 2 * (y / 4)) % 6];
    return value * (1.0f - 0.1f * float(channel));
}

// Where the surface at a distance behind a pixel's centre is in a picture of another camera, in pixels of
// stored rows.
inline glm::vec2 projected(const GBufferConventions& c, const Camera& from, const Camera& to, Extent2D extent,
                           glm::vec2 pixel, float distance) {
    const double rows = c.firstRow == FirstRow::top ? -1.0 : 1.0;
    const double forward = c.handedness == Handedness::right ? -1.0 : 1.0;
    const glm::dmat4 p(from.projection);
    const glm::dvec2 at(pixel), size(extent.width, extent.height);
    const glm::dvec2 ndc(at.x / size.x * 2.0 - 1.0, rows * (at.y / size.y * 2.0 - 1.0));
    glm::dvec4 view(0, 0, forward * double(distance), 1);
    for (int i = 0; i < 2; ++i)
        view[i] = c.projection == Projection::perspective
                      ? (ndc[i] * double(distance) - p[2][i] * view.z) / p[i][i]
                      : (ndc[i] - p[3][i]) / p[i][i];
    const glm::dvec4 clip =
        glm::dmat4(to.projection) * glm::dmat4(to.view) * glm::inverse(glm::dmat4(from.view)) * view;
    const glm::dvec2 there = glm::dvec2(clip) / clip.w;
    return {(there.x + 1.0) * 0.5 * size.x, (rows * there.y + 1.0) * 0.5 * size.y};
}

// The scene's distances, planar whatever the conventions.
inline Picture distances(const GBufferConventions& conventions, Extent2D extent) {
    GBufferConventions c = conventions;
    c.depthEncoding = DepthEncoding::planar;
    return sceneFrame(c, extent, tiltedWorld).depth;
}

inline CheckFrame correctFrame(const GBufferConventions& c, Extent2D extent) {
    const Frame scene = sceneFrame(c, extent, tiltedWorld);
    CheckFrame f;
    f.settings.resolution = extent;
    f.settings.conventions = c;
    f.settings.lit = f.settings.motion = true;
    f.camera = f.previousCamera = scene.camera;
    const glm::vec3 step = glm::mat3(glm::inverse(scene.camera.view)) * glm::vec3(0.3f, -0.2f, 0.1f);
    f.previousCamera.view = scene.camera.view * glm::translate(glm::mat4(1.0f), step);
    f.depth = scene.depth;
    f.normal = scene.normal;
    f.albedo = f.radiance = f.lit = Picture(extent, 3);
    f.motion = Picture(extent, 2);
    const Picture distance = distances(c, extent);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            for (int k = 0; k < 3; ++k) {
                f.albedo.at(x, y, k) = albedoAt(x, y, k);
                f.radiance.at(x, y, k) = albedoAt(x, y, k) * scene.radiance.at(x, y, k);
                f.lit.at(x, y, k) = 1.5f * f.radiance.at(x, y, k);
            }
            if (distance.at(x, y, 0) == 0.0f) continue;
            const glm::vec2 here(float(x) + 0.5f, float(y) + 0.5f);
            const glm::vec2 there =
                projected(c, f.camera, f.previousCamera, extent, here, distance.at(x, y, 0));
            f.motion.at(x, y, 0) = there.x - here.x;
            f.motion.at(x, y, 1) = there.y - here.y;
        }
    return f;
}

inline InputStatistics measure(CheckFrame& f, const cpu::Device& device) {
    Picture statistics(inputStatisticsExtent, 4, -1.0f);
    auto plan = planInputCheck(f.settings);
    REQUIRE_MESSAGE(plan, (plan ? "" : plan.error().message));
    auto program = device.compile(*plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    const InputCheckFrame<cpu::Image> frame{
        f.camera,           f.previousCamera, f.depth.image(),    f.normal.image(), f.albedo.image(),
        f.radiance.image(), f.lit.image(),    f.emission.image(), f.motion.image(), statistics.image()};
    auto inputs = inputCheckInputs(f.settings, frame);
    REQUIRE_MESSAGE(inputs, (inputs ? "" : inputs.error().message));
    const auto recorded = program->record(*inputs);
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    InputStatistics result{};
    std::copy(statistics.values.begin(), statistics.values.end(), result.begin());
    return result;
}

inline std::vector<InputFinding> findingsOf(CheckFrame& f, const cpu::Device& device) {
    return examineInputs(f.settings, f.camera, measure(f, device));
}

inline std::string sentences(const std::vector<InputFinding>& findings) {
    std::string text;
    for (const InputFinding& finding : findings)
        text += std::string(name(finding.problem)) + ": " + finding.sentence + "\n";
    return text;
}

inline std::set<std::string> problems(const std::vector<InputFinding>& findings) {
    std::set<std::string> names;
    for (const InputFinding& finding : findings) names.insert(name(finding.problem));
    return names;
}

} // namespace rebound::test
