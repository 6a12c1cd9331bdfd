// SPDX-License-Identifier: MIT
// A room's corner with a sphere, as a G-buffer under any convention, and frames of screen_indirect on the
// CPU.
#pragma once

#include "kernel_runner.hpp"
#include "test_camera.hpp"

#include "rebound/techniques/screen_indirect.hpp"

#include <cmath>
#include <limits>

namespace rebound::test {

struct Frame {
    ScreenIndirectSettings settings;
    Camera camera;
    Picture depth, normal, radiance, albedo, lit;
};

struct Outputs {
    Picture indirect, composed;
};

// Where a ray meets the scene, and what is there.
struct Hit {
    double t = std::numeric_limits<double>::infinity();
    glm::dvec3 normal{0.0}, radiance{0.0};
};

// The walls x = -2, y = -1.2 and z = -7 of a room, seen from within, and a sphere. All lengths times scale.
inline Hit meetScene(glm::dvec3 origin, glm::dvec3 ray, double scale) {
    Hit hit;
    auto meet = [&](double t, glm::dvec3 normal, glm::dvec3 color) {
        if (!(t > 0.0 && t < hit.t)) return;
        const glm::dvec3 p = (origin + t * ray) / scale;
        hit = {t, normal, color * (1.0 + 0.5 * std::sin(3.0 * p.x + 2.0 * p.y + p.z))};
    };
    meet((-2.0 * scale - origin.x) / ray.x, {1, 0, 0}, {4, 1, 0.5});
    meet((-1.2 * scale - origin.y) / ray.y, {0, 1, 0}, {1, 1, 1});
    meet((-7.0 * scale - origin.z) / ray.z, {0, 0, 1}, {0.5, 3, 1});
    const glm::dvec3 center = glm::dvec3(-0.6, -0.5, -4.5) * scale;
    const double radius = 0.7 * scale, a = glm::dot(ray, ray), b = glm::dot(ray, center - origin);
    const double c = glm::dot(center - origin, center - origin) - radius * radius, d = b * b - a * c;
    if (d > 0.0) {
        const double t = (b - std::sqrt(d)) / a;
        meet(t, (origin + t * ray - center) / radius, {0.5, 0.5, 4});
    }
    return hit;
}

// How the camera is turned in the scene: to the left and down, so that it sees walls and floor in either
// projection.
inline const glm::dmat4 gaze =
    glm::rotate(glm::rotate(glm::dmat4(1.0), 0.25, glm::dvec3(0, 1, 0)), -0.15, glm::dvec3(1, 0, 0));

// The scene's G-buffer. world: where the scene stands in the world; the camera moves with it, so that the
// picture stays.
inline Frame sceneFrame(const GBufferConventions& c, Extent2D extent, glm::mat4 world = glm::mat4(1.0f),
                        double scale = 1.0) {
    Lens lens;
    lens.nearDistance *= scale;
    lens.farDistance *= scale;
    if (c.projection == Projection::orthographic) {
        lens.halfWidth *= 1.8 * scale;
        lens.halfHeight *= 1.8 * scale;
    }
    lens.flipY = c.firstRow == FirstRow::bottom; // the same picture in memory
    Frame f;
    f.settings.resolution = extent;
    f.settings.conventions = c;
    f.settings.ringRadius = 12.0f;
    f.settings.samplesPerLevel = 32;
    f.camera = {viewOf(c, glm::mat4(glm::inverse(glm::dmat4(world) * gaze))), projectionOf(c, lens)};
    f.depth = Picture(extent, 1,
                      c.depthEncoding == DepthEncoding::device && c.depthDirection == DepthDirection::forward
                          ? 1.0f
                          : 0.0f);
    f.normal = f.radiance = f.albedo = f.lit = Picture(extent, 3);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const glm::dvec2 ndc((x + 0.5) / extent.width * 2.0 - 1.0 - lens.shiftX,
                                 1.0 - (y + 0.5) / extent.height * 2.0 - lens.shiftY);
            const glm::dvec2 at(ndc.x * lens.halfWidth, ndc.y * lens.halfHeight);
            const bool perspective = c.projection == Projection::perspective;
            const glm::dmat3 turn(gaze);
            const Hit hit = perspective
                                ? meetScene({0, 0, 0}, turn * glm::dvec3(at, -1), scale)
                                : meetScene(turn * glm::dvec3(at, 0), turn * glm::dvec3(0, 0, -1), scale);
            for (int k = 0; k < 3; ++k) {
                f.albedo.at(x, y, k) = 0.2f + 0.1f * float((x + k) % 5);
                f.lit.at(x, y, k) = 0.01f * float((3 * x + 7 * y + k) % 100);
            }
            if (hit.t > 30.0 * scale) continue;
            f.depth.at(x, y, 0) = storedDepth(c, lens, hit.t);
            const glm::vec3 n = storedNormal(c, f.camera.view, glm::mat3(world) * glm::vec3(hit.normal));
            for (int k = 0; k < 3; ++k) {
                f.normal.at(x, y, k) = n[k];
                f.radiance.at(x, y, k) = float(hit.radiance[k]);
            }
        }
    return f;
}

inline void empty(Frame& f, int x, int y) {
    const GBufferConventions& c = f.settings.conventions;
    f.depth.at(x, y, 0) =
        c.depthEncoding == DepthEncoding::device && c.depthDirection == DepthDirection::forward ? 1.0f : 0.0f;
}

inline Outputs render(Frame f, const cpu::Device& device) {
    const Extent2D extent = f.settings.resolution;
    Outputs out{Picture(extent, 3, -1.0f), Picture(extent, 3, -1.0f)};
    auto plan = planScreenIndirect(f.settings);
    REQUIRE_MESSAGE(plan, (plan ? "" : plan.error().message));
    auto program = device.compile(*plan);
    REQUIRE_MESSAGE(program, (program ? "" : program.error().message));
    ScreenIndirectFrame<cpu::Image> frame{
        f.camera,         f.depth.image(), f.normal.image(),     f.radiance.image(),
        f.albedo.image(), f.lit.image(),   out.indirect.image(), out.composed.image()};
    auto inputs = screenIndirectInputs(f.settings, frame);
    REQUIRE_MESSAGE(inputs, (inputs ? "" : inputs.error().message));
    const auto recorded = program->record(*inputs);
    REQUIRE_MESSAGE(recorded, (recorded ? "" : recorded.error().message));
    return out;
}

inline bool allFinite(const Picture& p) {
    for (float v : p.values)
        if (!std::isfinite(v)) return false;
    return true;
}

inline double mean(const Picture& p) {
    double sum = 0.0;
    for (float v : p.values) sum += v;
    return sum / double(p.values.size());
}

// The largest difference of two pictures, and the mean one, relative to the first one's mean.
struct Difference {
    double largest = 0.0, average = 0.0;
};
inline Difference difference(const Picture& a, const Picture& b) {
    Difference d;
    const double scale = mean(a);
    for (size_t i = 0; i < a.values.size(); ++i) {
        const double e = std::abs(double(a.values[i]) - double(b.values[i])) / scale;
        d.largest = std::max(d.largest, std::isnan(e) ? std::numeric_limits<double>::infinity() : e);
        d.average += e / double(a.values.size());
    }
    return d;
}

} // namespace rebound::test
