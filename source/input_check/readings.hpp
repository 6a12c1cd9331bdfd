// SPDX-License-Identifier: MIT
// Ways to read depth, normals and motion, as stated and as they may have been meant.
#pragma once

#include "rebound/detail/input_check_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rebound::detail {

#include "rebound/techniques/input_check_constants.h"

inline double forwardSign(const GBufferConventions& c) {
    return c.handedness == Handedness::right ? -1.0 : 1.0;
}
inline double lowestDepth(DepthRange r) { return r == DepthRange::zeroToOne ? 0.0 : -1.0; }
inline DepthMapping depthMapping(const Camera& camera) {
    const glm::mat4& p = camera.projection;
    return {p[2][2], p[3][2], p[2][3], p[3][3]};
}

// Near and far plane [m], the latter infinite where nothing is too far. Planar depth leaves open which depths
// clip, so its planes are the widest of every range.
struct DepthPlanes {
    double nearDistance = 0.0, farDistance = 0.0;
};
inline DepthPlanes depthPlanes(const Camera& camera, const GBufferConventions& c) {
    const double infinity = std::numeric_limits<double>::infinity();
    const DepthMapping m = depthMapping(camera);
    const bool device = c.depthEncoding == DepthEncoding::device,
               perspective = c.projection == Projection::perspective;
    DepthPlanes planes{infinity, -infinity};
    for (double ndc : {-1.0, 0.0, 1.0}) {
        if (device && ndc < lowestDepth(c.depthRange)) continue;
        if (device && ndc == 0.0 && c.depthRange == DepthRange::minusOneToOne) continue;
        const double z = forwardSign(c) * m.viewZ(ndc);
        if (std::isnan(z) || (perspective && z < 0.0 && std::isfinite(z))) continue;
        planes.nearDistance = std::min(planes.nearDistance, std::abs(z) == infinity ? infinity : z);
        planes.farDistance = std::max(planes.farDistance, std::abs(z) == infinity ? infinity : z);
    }
    if (!(planes.nearDistance < planes.farDistance)) return {0.0, infinity};
    if (perspective && planes.farDistance > 1e6 * planes.nearDistance) planes.farDistance = infinity;
    return planes;
}

// Half floats and rounding move a surface at a plane by less than 2 %.
inline PlaneConstants planeConstants(const Camera& camera, const GBufferConventions& c) {
    const DepthPlanes planes = depthPlanes(camera, c);
    const double nearest = planes.nearDistance - 0.02 * std::abs(planes.nearDistance);
    const double farthest = planes.farDistance + 0.02 * std::abs(planes.farDistance);
    return {{float(nearest), float(std::min(farthest, 1e30)), 0, 0}};
}

// How depth may have been meant, where it is not as stated; see docs/input_check.md.
enum class DepthMeaning {
    stated,
    reversed,   // device depth that runs the other way
    otherRange, // device depth of the other range
    planar,     // a distance along the axis, or one divided by the far plane's
    radial,     // a distance along the ray
    device,     // device depth in place of planar depth, of either range
    deviceMinusOne,
    deviceReversed,
};

inline std::array<DepthMeaning, size_t(depthReadingCount)> depthMeanings(const GBufferConventions& c) {
    using enum DepthMeaning;
    if (c.depthEncoding == DepthEncoding::device) return {stated, reversed, otherRange, planar, radial};
    return {stated, radial, device, deviceMinusOne, deviceReversed};
}

// Normalised device depth is start + slope * stored.
inline DepthReading deviceReading(const Camera& camera, const GBufferConventions& c, double start,
                                  double slope) {
    const DepthMapping m = depthMapping(camera);
    const double forward = forwardSign(c);
    return {{forward * (start * m.d - m.b), forward * slope * m.d, m.a - start * m.c, -slope * m.c},
            {0, 0, 0, 0}};
}

inline DepthReading depthReading(DepthMeaning meaning, const Camera& camera, const GBufferConventions& c,
                                 const CameraConstants& stated) {
    const double low = lowestDepth(c.depthRange);
    switch (meaning) {
    case DepthMeaning::stated:
        break;
    case DepthMeaning::reversed:
        return deviceReading(camera, c, 1.0, low - 1.0);
    case DepthMeaning::otherRange:
        return deviceReading(camera, c, -1.0 - low, low + 2.0);
    case DepthMeaning::planar:
        return {{0, 1, 1, 0}, {0, 0, 0, 0}};
    case DepthMeaning::radial:
        return {{0, 1, 1, 0}, {1, 0, 0, 0}};
    case DepthMeaning::device:
        return deviceReading(camera, c, 0.0, 1.0);
    case DepthMeaning::deviceMinusOne:
        return deviceReading(camera, c, -1.0, 2.0);
    case DepthMeaning::deviceReversed:
        return deviceReading(camera, c, 1.0, -1.0);
    }
    return {stated.depth, {0, 0, 0, 0}};
}

inline std::array<DepthReading, size_t(depthReadingCount)>
depthReadings(const Camera& camera, const GBufferConventions& c, const CameraConstants& stated) {
    std::array<DepthReading, size_t(depthReadingCount)> readings;
    const auto meanings = depthMeanings(c);
    for (size_t i = 0; i < readings.size(); ++i) readings[i] = depthReading(meanings[i], camera, c, stated);
    return readings;
}

// The stated unit, then the others.
inline std::array<MotionUnit, 3> motionUnits(MotionUnit stated) {
    std::array<MotionUnit, 3> units{MotionUnit::pixels, MotionUnit::textureCoordinates,
                                    MotionUnit::normalizedDevice};
    std::stable_partition(units.begin(), units.end(), [stated](MotionUnit u) { return u == stated; });
    return units;
}

inline MotionConstants motionConstants(const InputCheckSettings& s, const Camera& camera,
                                       const Camera& previous) {
    const auto scale = [&](MotionUnit unit) {
        return motionToPixels({unit, s.motionConventions.direction}, s.conventions, s.resolution);
    };
    const auto units = motionUnits(s.motionConventions.unit);
    return {reprojection(camera, previous, s.conventions, s.resolution),
            glm::vec4(scale(units[0]), scale(units[1])), glm::vec4(scale(units[2]), 0.0f, 0.0f)};
}

// What may be wrong with normals beside their encoding and their space.
enum class NormalChange {
    none,
    negated,
    viewX, // that component of view space has the wrong sign
    viewY,
    viewZ,
    worldX,
    worldY,
    worldZ,
    transposed, // the view matrix's inverse was used
    zUp,        // y and z of world space are exchanged, one with a sign
    zUpNegated,
};
inline constexpr int normalChangeCount = int(NormalChange::zUpNegated) + 1;

struct NormalReading {
    NormalSpace space = NormalSpace::world;
    NormalEncoding encoding = NormalEncoding::signedUnit;
    NormalChange change = NormalChange::none;
};

// From stored normals, once they are signed, to the view space of CameraConstants.
inline glm::dmat3 normalMatrix(const NormalReading& r, const Camera& camera, const GBufferConventions& c) {
    const auto flip = [](int axis) {
        glm::dmat3 m(1.0);
        m[axis][axis] = -1.0;
        return m;
    };
    glm::dmat3 view = r.space == NormalSpace::world ? glm::dmat3(glm::mat3(camera.view)) : glm::dmat3(1.0);
    if (r.change == NormalChange::transposed) view = glm::transpose(view);
    if (r.change == NormalChange::zUp) view = view * glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    if (r.change == NormalChange::zUpNegated) view = view * glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0});
    if (r.change >= NormalChange::worldX && r.change <= NormalChange::worldZ)
        view = view * flip(int(r.change) - int(NormalChange::worldX));
    glm::dmat3 forward(1.0);
    forward[2][2] = forwardSign(c);
    glm::dmat3 result = forward * view;
    if (r.change >= NormalChange::viewX && r.change <= NormalChange::viewZ)
        result = flip(int(r.change) - int(NormalChange::viewX)) * result;
    return r.change == NormalChange::negated ? -1.0 * result : result;
}

// Whether a change means something in that space.
inline bool applies(NormalChange change, NormalSpace space) {
    return space == NormalSpace::world || change <= NormalChange::viewZ;
}

// A row of statistics of the geometry under one reading of depth: .xyz of rows 0 to 2 correlate, .w sums
// normals.
struct GeometryRow {
    const float* values;
    double lengths(NormalEncoding e) const {
        return values[e == NormalEncoding::signedUnit ? GeometryStatistic::lengthIfSigned
                                                      : GeometryStatistic::lengthIfUnsigned];
    }
    double judged() const { return values[GeometryStatistic::judged]; }
    double surfaces() const { return values[GeometryStatistic::surfaces]; }

    // The mean cosine between stored normals under a reading and those of the geometry, weighed by stored
    // length.
    double meanCosine(const glm::dmat3& toView, NormalEncoding encoding) const {
        double correlation = 0.0, bias = 0.0;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                correlation += toView[column][row] * double(values[4 * row + column]);
                bias += toView[column][row] * double(values[4 * row + 3]);
            }
        const double sum = encoding == NormalEncoding::signedUnit ? correlation : 2.0 * correlation - bias;
        return lengths(encoding) > 0.0 ? sum / lengths(encoding) : 0.0;
    }
};

// A way to read depth and normals, and how well the two then agree.
struct GeometryReading {
    int depth = 0;
    NormalReading normal;
    int changes = 0;     // from what is stated
    double cosine = 0.0; // mean, 1: they agree; not above 0 where this reading sees no surfaces
};

inline std::vector<GeometryReading> geometryReadings(const InputCheckSettings& s, const Camera& camera,
                                                     const InputStatistics& statistics) {
    const GBufferConventions& c = s.conventions;
    std::vector<GeometryReading> readings;
    const auto rowOf = [&](int depth) {
        return GeometryRow{statistics.data() + size_t(16) * size_t(int(StatisticRow::geometry0) + depth)};
    };
    double most = 0.0;
    for (int depth = 0; depth < depthReadingCount; ++depth) most = std::max(most, rowOf(depth).surfaces());
    for (int depth = 0; depth < depthReadingCount; ++depth)
        for (NormalSpace space : {NormalSpace::view, NormalSpace::world})
            for (NormalEncoding encoding : {NormalEncoding::signedUnit, NormalEncoding::unsignedUnit})
                for (int change = 0; change < normalChangeCount; ++change) {
                    const NormalReading normal{space, encoding, NormalChange(change)};
                    if (!applies(normal.change, space)) continue;
                    const GeometryRow row = rowOf(depth);
                    GeometryReading r{depth, normal, 0,
                                      row.meanCosine(normalMatrix(normal, camera, c), encoding)};
                    // A reading under which few pixels are surfaces explains few.
                    r.cosine *= most > 0.0 ? std::min(1.0, 2.0 * row.surfaces() / most) : 0.0;
                    r.changes = (depth != 0) + (space != c.normalSpace) + (encoding != c.normalEncoding) +
                                (change != 0);
                    readings.push_back(r);
                }
    return readings;
}

// Another reading is taken only where it leaves well under two thirds of the disagreement, for each thing
// that it changes.
inline constexpr double explainingFactor = 0.6;

// The reading that explains the frame best, where each change has to earn its place.
inline GeometryReading explain(const std::vector<GeometryReading>& readings) {
    GeometryReading best;
    for (int changes = 0; changes <= 4; ++changes) {
        GeometryReading candidate{0, {}, changes, -1.0};
        for (const GeometryReading& r : readings)
            if (r.changes == changes && r.cosine > candidate.cosine) candidate = r;
        if (changes == 0) best = candidate;
        const double needed = std::pow(explainingFactor, changes - best.changes);
        if (changes > 0 && 1.0 - candidate.cosine < needed * (1.0 - best.cosine)) best = candidate;
    }
    return best;
}

} // namespace rebound::detail
