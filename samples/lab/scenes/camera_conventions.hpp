// SPDX-License-Identifier: MIT
// G-buffers of every convention: projections, depth and normals, built from what the conventions say and not from the
// library under test.
#pragma once

#include "rebound/camera.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <vector>

namespace rebound::lab {

struct Lens {
    double nearDistance = 0.5, farDistance = 40.0; // [m]
    double halfWidth = 0.9, halfHeight = 0.55;     // at distance 1, or, orthographic, as they are [m]
    double shiftX = 0.05, shiftY = -0.03;          // of the middle, in normalised device coordinates
    bool flipY = false; // turns the picture upside down in normalised device coordinates
};

// Normalised device depth of the planes that clip.
inline double nearDepth(const GBufferConventions& c) {
    const double low = c.depthRange == DepthRange::zeroToOne ? 0.0 : -1.0;
    return c.depthDirection == DepthDirection::forward ? low : 1.0;
}
inline double farDepth(const GBufferConventions& c) {
    const double low = c.depthRange == DepthRange::zeroToOne ? 0.0 : -1.0;
    return c.depthDirection == DepthDirection::forward ? 1.0 : low;
}

// Normalised device depth is (a distance + b) / distance, or, orthographic, a distance + b.
struct DepthLine {
    double a, b;
};
inline DepthLine depthLine(const GBufferConventions& c, const Lens& lens) {
    const double n0 = nearDepth(c), n1 = farDepth(c), n = lens.nearDistance, f = lens.farDistance;
    if (c.projection == Projection::orthographic) {
        const double a = (n1 - n0) / (f - n);
        return {a, n0 - a * n};
    }
    const double b = c.farPlane == FarPlane::infinite ? (n0 - n1) * n : (n0 - n1) / (1.0 / n - 1.0 / f);
    return {n0 - b / n, b};
}

inline glm::mat4 projectionOf(const GBufferConventions& c, const Lens& lens) {
    const double forward = c.handedness == Handedness::right ? -1.0 : 1.0;
    const bool perspective = c.projection == Projection::perspective;
    const double flip = lens.flipY ? -1.0 : 1.0;
    const DepthLine depth = depthLine(c, lens);
    glm::dmat4 p(0.0);
    p[0][0] = 1.0 / lens.halfWidth;
    p[1][1] = flip / lens.halfHeight;
    p[2][2] = depth.a * forward;
    p[3][2] = depth.b;
    if (perspective) {
        p[2][0] = lens.shiftX * forward;
        p[2][1] = lens.shiftY * flip * forward;
        p[2][3] = forward;
    } else {
        p[3][0] = lens.shiftX;
        p[3][1] = lens.shiftY * flip;
        p[3][3] = 1.0;
    }
    return glm::mat4(p);
}

// Turns a right-handed view matrix into one of the conventions.
inline glm::mat4 viewOf(const GBufferConventions& c, const glm::mat4& rightHanded) {
    return c.handedness == Handedness::right ? rightHanded
                                             : glm::scale(glm::mat4(1.0f), glm::vec3(1, 1, -1)) * rightHanded;
}

// Stored depth of a surface at a distance along the viewing axis.
inline float storedDepth(const GBufferConventions& c, const Lens& lens, double distance) {
    if (c.depthEncoding == DepthEncoding::planar) return float(distance);
    const DepthLine line = depthLine(c, lens);
    const double ndc = c.projection == Projection::perspective ? (line.a * distance + line.b) / distance
                                                               : line.a * distance + line.b;
    return float(c.depthRange == DepthRange::zeroToOne ? ndc : 0.5 * ndc + 0.5);
}

inline glm::vec3 storedNormal(const GBufferConventions& c, const glm::mat4& view, glm::vec3 world) {
    const glm::vec3 n = c.normalSpace == NormalSpace::world ? world : glm::mat3(view) * world;
    return c.normalEncoding == NormalEncoding::signedUnit ? n : 0.5f * n + 0.5f;
}

// Every combination that makes sense: no infinite far plane where the projection is orthographic, and planar
// depth with one range, direction and far plane, which it does not have.
inline std::vector<GBufferConventions> everyConvention() {
    std::vector<GBufferConventions> all;
    for (int bits = 0; bits < 512; ++bits) {
        auto bit = [bits](int i) { return (bits >> i & 1) != 0; };
        GBufferConventions c;
        c.depthEncoding = DepthEncoding(bit(0));
        c.depthRange = DepthRange(bit(1));
        c.depthDirection = DepthDirection(bit(2));
        c.farPlane = FarPlane(bit(3));
        c.projection = Projection(bit(4));
        c.handedness = Handedness(bit(5));
        c.firstRow = FirstRow(bit(6));
        c.normalSpace = NormalSpace(bit(7));
        c.normalEncoding = NormalEncoding(bit(8));
        const bool planar = c.depthEncoding == DepthEncoding::planar;
        if (planar && (bit(1) || bit(2) || bit(3))) continue;
        if (c.projection == Projection::orthographic && c.farPlane == FarPlane::infinite) continue;
        all.push_back(c);
    }
    return all;
}

} // namespace rebound::lab
