// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace rebound::engine {

Camera cameraOf(const lab::CameraView& view, Extent2D extent) {
    const double aspect = double(extent.width) / double(extent.height), farPlane = double(view.farPlane);
    // The lab's near plane may be 0, which a depth buffer cannot.
    const double nearPlane = std::max(double(view.nearPlane), 1e-5 * farPlane),
                 top = 0.5 * double(view.orthographicHeight);
    const glm::dmat4 p =
        view.orthographic
            ? glm::orthoRH_NO(-top * aspect, top * aspect, -top, top, nearPlane, farPlane)
            : glm::perspectiveRH_NO(double(view.verticalFieldOfView), aspect, nearPlane, farPlane);
    return {glm::mat4(glm::lookAtRH(glm::dvec3(view.position), glm::dvec3(view.target), glm::dvec3(view.up))),
            glm::mat4(p)};
}

// [rebound conventions]
// How the G-buffer is to be read: each line is a decision that the renderer, or OpenGL, has made.
GBufferConventions conventionsOf(const lab::CameraView& view) {
    GBufferConventions c;
    c.depthEncoding = DepthEncoding::device; // the depth attachment itself
    c.depthRange =
        DepthRange::minusOneToOne; // OpenGL's clip space; glClipControl(.., GL_ZERO_TO_ONE) changes it
    c.depthDirection = DepthDirection::forward; // cleared to 1, compared with GL_LESS
    c.farPlane = FarPlane::finite;
    c.projection = view.orthographic ? Projection::orthographic : Projection::perspective;
    c.handedness = Handedness::right; // the camera looks down -z
    c.firstRow = FirstRow::bottom;    // a texture's row 0 has normalised device y = -1
    c.normalSpace = NormalSpace::world;
    c.normalEncoding = NormalEncoding::signedUnit; // a float format
    return c;
}
// [/rebound conventions]

} // namespace rebound::engine
