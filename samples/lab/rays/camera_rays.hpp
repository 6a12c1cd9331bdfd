// SPDX-License-Identifier: MIT
// The rays of a camera through pixel centres. Depth is the distance along the viewing axis.
#pragma once

#include "lab/scenes/scene.hpp"
#include "rebound/extent.hpp"

#include <optional>

namespace rebound::lab {

// A view direction and an up vector that vanish or agree, angles and planes out of range, and values that are
// not finite are errors; the far plane may be infinite.
Result<> validate(const CameraView&);

// origin + depth * direction is the point at that depth; direction is not of unit length in perspective.
struct CameraRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
};

class CameraRays {
public:
    // Precondition: validate(camera) succeeds and the extent is positive.
    CameraRays(const CameraView& camera, Extent2D extent);

    // Through the centre of pixel (x, y), row 0 on top.
    CameraRay throughPixel(int x, int y) const;

    // The point's place in the picture [pixels, from its left upper corner], which may be beside it; nothing where the
    // point is behind the camera.
    std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const;

    // Where a ray from the camera to a point starts, and the point's depth; nothing where the point is beside the view
    // or behind the camera.
    struct Projection {
        glm::dvec3 origin;
        double depth;
    };
    std::optional<Projection> project(glm::dvec3 point) const;

private:
    // Across and up in halves of the view, and depth; nothing behind the camera.
    std::optional<glm::dvec3> place(glm::dvec3 point) const;

    Extent2D extent;
    bool orthographic = false;
    glm::dvec3 eye{0.0};
    glm::dvec3 forward{0.0};
    glm::dvec3 right{0.0}; // half the view's width at depth 1, or of the orthographic view
    glm::dvec3 up{0.0};    // likewise half its height
};

} // namespace rebound::lab
