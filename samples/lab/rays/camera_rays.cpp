// SPDX-License-Identifier: MIT
#include "lab/rays/camera_rays.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace rebound::lab {

namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

template <class... Parts>
Error cameraError(const CameraView& camera, const Parts&... parts) {
    std::ostringstream message;
    message << "camera \"" << camera.name << "\": ";
    (message << ... << parts);
    return invalidArgument(message.str());
}

Result<> validateProjection(const CameraView& camera) {
    const float angle = camera.verticalFieldOfView;
    if (!camera.orthographic && !(angle > 0.0f && angle < std::numbers::pi_v<float>))
        return cameraError(camera, "vertical field of view is ", angle,
                           " rad; expected more than 0 and less than pi");
    const float height = camera.orthographicHeight;
    if (camera.orthographic && !(height > 0.0f && std::isfinite(height)))
        return cameraError(camera, "orthographic height is ", height, " m; expected a positive number");
    if (!(camera.nearPlane >= 0.0f && camera.nearPlane < camera.farPlane))
        return cameraError(camera, "near and far planes are at ", camera.nearPlane, " and ", camera.farPlane,
                           " m; expected 0 <= near < far");
    return {};
}

} // namespace

Result<> validate(const CameraView& camera) {
    if (!finite(camera.position) || !finite(camera.target) || !finite(camera.up))
        return cameraError(camera, "position, target and up must be finite");
    const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.position);
    const glm::dvec3 up = camera.up;
    if (glm::length(view) == 0.0) return cameraError(camera, "position and target are the same point");
    // Below this sine the image's rotation about the axis is rounding noise.
    constexpr double smallestSine = 1e-6;
    if (!(glm::length(glm::cross(view, up)) > smallestSine * glm::length(view) * glm::length(up)))
        return cameraError(camera, "up is zero or parallel to the view direction");
    return validateProjection(camera);
}

CameraRays::CameraRays(const CameraView& camera, Extent2D imageExtent)
    : extent(imageExtent), orthographic(camera.orthographic), eye(camera.position) {
    forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    const glm::dvec3 side = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const double halfHeight = orthographic ? 0.5 * double(camera.orthographicHeight)
                                           : std::tan(0.5 * double(camera.verticalFieldOfView));
    right = side * (halfHeight * extent.width / extent.height);
    up = glm::cross(side, forward) * halfHeight;
}

CameraRay CameraRays::throughPixel(int x, int y) const {
    const glm::dvec3 offset =
        right * (2.0 * (x + 0.5) / extent.width - 1.0) + up * (1.0 - 2.0 * (y + 0.5) / extent.height);
    if (orthographic) return {eye + offset, forward};
    return {eye, forward + offset};
}

std::optional<glm::dvec3> CameraRays::place(glm::dvec3 point) const {
    const glm::dvec3 towards = point - eye;
    const double depth = glm::dot(towards, forward);
    if (!(depth > 0.0)) return std::nullopt;
    const double scale = orthographic ? 1.0 : 1.0 / depth;
    return glm::dvec3(glm::dot(towards, right) / glm::dot(right, right) * scale,
                      glm::dot(towards, up) / glm::dot(up, up) * scale, depth);
}

std::optional<glm::dvec2> CameraRays::pixelOf(glm::dvec3 point) const {
    const auto placed = place(point);
    if (!placed) return std::nullopt;
    return glm::dvec2((placed->x + 1.0) / 2.0 * extent.width, (1.0 - placed->y) / 2.0 * extent.height);
}

std::optional<CameraRays::Projection> CameraRays::project(glm::dvec3 point) const {
    const auto placed = place(point);
    if (!placed || !(std::abs(placed->x) <= 1.0 && std::abs(placed->y) <= 1.0)) return std::nullopt;
    return Projection{orthographic ? eye + placed->x * right + placed->y * up : eye, placed->z};
}

} // namespace rebound::lab
