// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace rebound::engine {

Camera cameraOf(const lab::CameraView& view, Extent2D extent) {
    const double aspect = double(extent.width) / double(extent.height);
    const double nearPlane = std::max(double(view.nearPlane), 1e-3); // the lab's may be 0
    glm::dmat4 p(0.0);
    if (view.orthographic) {
        const double top = 0.5 * double(view.orthographicHeight), span = double(view.farPlane) - nearPlane;
        p[0][0] = 1.0 / (top * aspect);
        p[1][1] = -1.0 / top;
        p[2][2] = 1.0 / span; // z is -nearPlane to -farPlane, depth 1 to 0
        p[3][2] = double(view.farPlane) / span;
        p[3][3] = 1.0;
    } else {
        const double f = 1.0 / std::tan(0.5 * double(view.verticalFieldOfView));
        p[0][0] = f / aspect;
        p[1][1] = -f;
        p[2][3] = -1.0;
        p[3][2] = nearPlane; // depth is nearPlane over distance
    }
    return {glm::mat4(glm::lookAtRH(glm::dvec3(view.position), glm::dvec3(view.target), glm::dvec3(view.up))),
            glm::mat4(p)};
}

// [rebound conventions]
// How the G-buffer is to be read: each line is a decision that the renderer has made.
GBufferConventions conventionsOf(const lab::CameraView& view) {
    GBufferConventions c;
    c.depthEncoding = DepthEncoding::device;     // the depth attachment itself
    c.depthRange = DepthRange::zeroToOne;        // Vulkan's clip space
    c.depthDirection = DepthDirection::reversed; // cleared to 0, compared with GREATER
    c.farPlane = view.orthographic ? FarPlane::finite : FarPlane::infinite;
    c.projection = view.orthographic ? Projection::orthographic : Projection::perspective;
    c.handedness = Handedness::right; // the camera looks down -z
    c.firstRow = FirstRow::bottom;    // viewport of positive height: row 0 has normalised device y = -1,
                                      // and the projection's negative m11 says that this is up
    c.normalSpace = NormalSpace::world;
    c.normalEncoding = NormalEncoding::signedUnit; // a float format
    return c;
}
// [/rebound conventions]

} // namespace rebound::engine
