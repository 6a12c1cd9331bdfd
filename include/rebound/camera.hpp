// SPDX-License-Identifier: MIT
// Cameras, and the conventions by which an engine's G-buffer is to be read: a value, validated at run time.
#pragma once

#include "rebound/extent.hpp"
#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace rebound {

enum class DepthEncoding {
    device, // what the depth test compares, as depth textures store it: 0 to 1
    planar, // distance along the viewing axis [m]; 0: no surface
};
// Normalised device depth of the planes that clip, which device depth maps to 0 to 1.
enum class DepthRange { zeroToOne, minusOneToOne };
enum class DepthDirection { forward, reversed }; // reversed: the near plane has the greater depth
enum class FarPlane { finite, infinite };
enum class Projection { perspective, orthographic };
enum class Handedness { right, left }; // of view space: the camera looks down -z, or +z
enum class FirstRow {
    top, // row 0 has normalised device y = +1 (Direct3D, Metal, files; Vulkan with a viewport of negative height)
    bottom, // row 0 has normalised device y = -1 (OpenGL; Vulkan with a viewport of positive height)
};
enum class NormalSpace { view, world };
enum class NormalEncoding {
    signedUnit,   // components -1 to 1
    unsignedUnit, // components 0 to 1, standing for -1 to 1
};

// How a G-buffer was written. The defaults are OpenEXR's and the lab's.
struct GBufferConventions {
    DepthEncoding depthEncoding = DepthEncoding::planar;
    DepthRange depthRange = DepthRange::zeroToOne;
    DepthDirection depthDirection = DepthDirection::forward;
    FarPlane farPlane = FarPlane::finite;
    Projection projection = Projection::perspective;
    Handedness handedness = Handedness::right;
    FirstRow firstRow = FirstRow::top;
    NormalSpace normalSpace = NormalSpace::world;
    NormalEncoding normalEncoding = NormalEncoding::signedUnit;
};

enum class MotionUnit {
    pixels,
    textureCoordinates, // the picture is 1 wide and 1 high; y runs with the rows, as the image is stored
    normalizedDevice,   // the picture is 2 wide and 2 high; y runs as the projection's
};
enum class MotionDirection {
    toPrevious,  // where the surface was, less where it is
    fromPrevious // where it is, less where it was
};

// How motion vectors were written.
struct MotionConventions {
    MotionUnit unit = MotionUnit::pixels;
    MotionDirection direction = MotionDirection::toPrevious;
};

// Factors of a stored motion vector that make of it the way from where a surface is to where it was, along the image's
// columns and rows [pixels].
inline glm::vec2 motionToPixels(const MotionConventions& motion, const GBufferConventions& conventions,
                                Extent2D extent) {
    const glm::vec2 size(extent.width, extent.height);
    const float sign = motion.direction == MotionDirection::toPrevious ? 1.0f : -1.0f;
    if (motion.unit == MotionUnit::pixels) return glm::vec2(sign);
    if (motion.unit == MotionUnit::textureCoordinates) return sign * size;
    return sign * 0.5f * size * glm::vec2(1.0f, conventions.firstRow == FirstRow::top ? -1.0f : 1.0f);
}

// The matrices with which the G-buffer was rendered; column vectors, as GLM has them.
struct Camera {
    glm::mat4 view{1.0f};       // world to view space: a rotation and a translation
    glm::mat4 projection{1.0f}; // view to clip space
};

namespace detail {
#include "rebound/math/uniform_types.h"
#include "rebound/techniques/camera_constants.h"
#include "rebound/techniques/reprojection_constants.h"

inline const char* name(Projection p) {
    return p == Projection::perspective ? "perspective" : "orthographic";
}

// The projection's rows for z and w as functions of view-space z: ndc = (a z + b) / (c z + d).
struct DepthMapping {
    double a, b, c, d;
    // The view-space z whose normalised device depth is the argument; infinite where there is none.
    double viewZ(double ndc) const { return (ndc * d - b) / (a - ndc * c); }
};

inline Error projectionError(const std::string& what) { return invalidArgument("camera.projection " + what); }

inline Result<> checkProjectionForm(const glm::mat4& p, Projection projection) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(p[column][row])) return projectionError("holds a value that is not finite");
    if (p[0][0] == 0.0f || p[1][1] == 0.0f)
        return projectionError("has no width or no height: m00 or m11 is zero");
    if (p[0][1] != 0.0f || p[1][0] != 0.0f || p[0][2] != 0.0f || p[1][2] != 0.0f || p[0][3] != 0.0f ||
        p[1][3] != 0.0f)
        return projectionError(
            "is sheared or rotated; a projection with axes along the screen's was expected");
    const bool perspective = p[2][3] != 0.0f;
    if (perspective != (projection == Projection::perspective))
        return projectionError(std::string("is ") +
                               name(perspective ? Projection::perspective : Projection::orthographic) +
                               ", but conventions.projection says " + name(projection));
    if (perspective && (p[3][3] != 0.0f || std::abs(p[2][3]) != 1.0f || p[3][0] != 0.0f || p[3][1] != 0.0f))
        return projectionError(
            "must give w = z or w = -z, and x and y without offsets, where it is perspective");
    if (!perspective && (p[3][3] != 1.0f || p[2][0] != 0.0f || p[2][1] != 0.0f))
        return projectionError(
            "must give w = 1, and x and y that do not depend on z, where it is orthographic");
    return {};
}

// Checks that depth runs as the conventions say: between the range's ends, in their direction, to that far plane.
inline Result<> checkDepthConventions(const DepthMapping& m, const GBufferConventions& c, double forward) {
    const double low = c.depthRange == DepthRange::zeroToOne ? 0.0 : -1.0;
    const bool reversed = c.depthDirection == DepthDirection::reversed;
    const double nearDistance = forward * m.viewZ(reversed ? 1.0 : low);
    const double farDenominator = m.a - (reversed ? low : 1.0) * m.c;
    // Matrices in single precision leave a far plane of a million near distances where none was meant.
    const bool infinite = std::abs(farDenominator) <= 1e-6 * std::max(std::abs(m.a), std::abs(m.c));
    const double farDistance = forward * m.viewZ(reversed ? low : 1.0);
    if (c.projection == Projection::perspective && !(nearDistance > 0.0 && std::isfinite(nearDistance)))
        return projectionError("has its near plane at " + std::to_string(nearDistance) +
                               " m; conventions.depthRange, depthDirection or handedness does not fit it");
    if (infinite != (c.farPlane == FarPlane::infinite))
        return projectionError(std::string("has ") + (infinite ? "an infinite" : "a finite") +
                               " far plane, but conventions.farPlane says " +
                               (infinite ? "finite" : "infinite"));
    if (!infinite && !(farDistance > nearDistance))
        return projectionError("has its far plane at " + std::to_string(farDistance) +
                               " m, before its near plane at " + std::to_string(nearDistance) +
                               " m; conventions.depthRange, depthDirection or handedness does not fit it");
    return {};
}

inline Result<> checkView(const glm::mat4& view) {
    const glm::mat3 rotation(view);
    const glm::mat3 product = glm::transpose(rotation) * rotation;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            // Rotations composed in single precision stay orthonormal to about 1e-6; a scale of 0.1 % is a mistake.
            if (!(std::abs(product[column][row] - (column == row ? 1.0f : 0.0f)) < 1e-3f))
                return invalidArgument(
                    "camera.view is not a rotation with a translation; a world-to-view matrix "
                    "without scale or shear was expected");
    return {};
}

} // namespace detail

using CameraConstants = detail::CameraConstants;

// What kernels need of the camera, for a G-buffer of that size. Fails where the matrices contradict the conventions:
// projection, handedness, depth range, direction and far plane; with planar depth only the first two matter.
inline Result<CameraConstants> cameraConstants(const Camera& camera, const GBufferConventions& conventions,
                                               Extent2D extent) {
    const glm::mat4& p = camera.projection;
    if (auto form = detail::checkProjectionForm(p, conventions.projection); !form) return form.error();
    if (auto view = detail::checkView(camera.view); !view) return view.error();
    const double forward = conventions.handedness == Handedness::right ? -1.0 : 1.0;
    const bool perspective = conventions.projection == Projection::perspective;
    if (perspective && p[2][3] != float(forward))
        return detail::projectionError(std::string("looks down ") + (p[2][3] < 0.0f ? "-z" : "+z") +
                                       ", but conventions.handedness says " +
                                       (forward < 0.0 ? "right (-z)" : "left (+z)"));
    const detail::DepthMapping m{p[2][2], p[3][2], p[2][3], p[3][3]};
    const bool device = conventions.depthEncoding == DepthEncoding::device;
    if (device)
        if (auto depth = detail::checkDepthConventions(m, conventions, forward); !depth) return depth.error();

    CameraConstants k;
    // Pixel coordinate to normalised device x, y, then through the inverse of p to view space. Where a perspective p is
    // off centre, p20 z is proportional to w = forward z, so both cases are offsets of the ray.
    const double sx = 2.0 / extent.width,
                 sy = (conventions.firstRow == FirstRow::top ? -2.0 : 2.0) / extent.height;
    const double x0 = -1.0, y0 = conventions.firstRow == FirstRow::top ? 1.0 : -1.0;
    const double offsetX = perspective ? p[2][0] * forward : p[3][0],
                 offsetY = perspective ? p[2][1] * forward : p[3][1];
    k.ray = glm::vec4(sx / p[0][0], sy / p[1][1], (x0 - offsetX) / p[0][0], (y0 - offsetY) / p[1][1]);

    // Stored depth s is normalised device depth low + s (1 - low); z = forward (ndc d - b) / (a - ndc c).
    const double low = conventions.depthRange == DepthRange::zeroToOne ? 0.0 : -1.0, scale = 1.0 - low;
    k.depth =
        device ? glm::vec4(forward * (low * m.d - m.b), forward * scale * m.d, m.a - low * m.c, -scale * m.c)
               : glm::vec4(0.0f, 1.0f, 1.0f, 0.0f);
    k.empty =
        glm::vec4(device && conventions.depthDirection == DepthDirection::forward ? 1.0f : 0.0f, 0, 0, 0);

    glm::mat3 rotation =
        conventions.normalSpace == NormalSpace::world ? glm::mat3(camera.view) : glm::mat3(1.0f);
    for (int column = 0; column < 3; ++column) rotation[column].z *= float(forward);
    const bool isUnsigned = conventions.normalEncoding == NormalEncoding::unsignedUnit;
    const glm::vec3 bias = isUnsigned ? rotation * glm::vec3(-1.0f) : glm::vec3(0.0f);
    if (isUnsigned) rotation *= 2.0f;
    k.normalX = glm::vec4(rotation[0].x, rotation[1].x, rotation[2].x, bias.x);
    k.normalY = glm::vec4(rotation[0].y, rotation[1].y, rotation[2].y, bias.y);
    k.normalZ = glm::vec4(rotation[0].z, rotation[1].z, rotation[2].z, bias.z);
    return k;
}

using ReprojectionConstants = detail::ReprojectionConstants;

// Where surfaces that one camera sees, and that have not moved in the world, lie in the picture of another: of the frame
// before, or of another eye. Both pictures have that size and those conventions.
inline ReprojectionConstants reprojection(const Camera& from, const Camera& to,
                                          const GBufferConventions& conventions, Extent2D extent) {
    glm::dmat4 toEngine(1.0); // from the view space of CameraConstants, whose z is a distance
    toEngine[2][2] = conventions.handedness == Handedness::right ? -1.0 : 1.0;
    const glm::dmat4 rows = glm::transpose(glm::dmat4(to.projection) * glm::dmat4(to.view) *
                                           glm::inverse(glm::dmat4(from.view)) * toEngine);
    const double down = conventions.firstRow == FirstRow::top ? -1.0 : 1.0;
    return {glm::vec4(0.5 * extent.width * (rows[0] + rows[3])),
            glm::vec4(0.5 * extent.height * (down * rows[1] + rows[3])), glm::vec4(rows[3])};
}

} // namespace rebound
