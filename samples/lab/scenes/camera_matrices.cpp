// SPDX-License-Identifier: MIT
#include "lab/scenes/camera_matrices.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace rebound::lab {

namespace {

glm::dmat4 projectionOf(const CameraView& view, double aspect) {
    if (view.orthographic) {
        const double top = double(view.orthographicHeight) / 2.0;
        return glm::orthoRH_ZO(-top * aspect, top * aspect, -top, top, double(view.nearPlane),
                               double(view.farPlane));
    }
    return glm::infinitePerspectiveRH(double(view.verticalFieldOfView), aspect, double(view.nearPlane));
}

} // namespace

Camera cameraMatrices(const CameraView& view, Extent2D extent) {
    Camera camera;
    camera.view =
        glm::mat4(glm::lookAtRH(glm::dvec3(view.position), glm::dvec3(view.target), glm::dvec3(view.up)));
    camera.projection = glm::mat4(projectionOf(view, double(extent.width) / double(extent.height)));
    return camera;
}

} // namespace rebound::lab
