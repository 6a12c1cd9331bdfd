// SPDX-License-Identifier: MIT
// What finds out. Thresholds and their reasons: docs/input_check.md.
#pragma once

#include "readings.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace rebound::detail {

// A number as people read it.
inline std::string shortText(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}
inline std::string percent(double share) { return shortText(100.0 * share) + " %"; }

constexpr double strayShare = 1e-3;         // a few pixels of a frame are nobody's concern
constexpr double clearedShare = 0.01;       // of pixels exactly at the end of depth that is not the far one
constexpr double planeShare = 0.01;         // of surfaces outside the clipping planes
constexpr double lengthShare = 0.05;        // of normals that are not unit
constexpr double judgedShare = 0.005;       // of pixels that geometry must be seen at to judge normals by it
constexpr double agreeingResidual = 0.002;  // 1 - cosine, 4 degrees: normals agree with depth
constexpr double explainedCosine = 0.7;     // a reading that explains a frame reaches it
constexpr double contradictingCosine = 0.5; // below it, normals are not those of the depth's surfaces

// The value that half of the total exceeds, interpolated in logarithms; counts above bounds that grow by a
// factor.
inline double medianOf(const float* counts, double total, double bound, double step) {
    double above = total;
    for (int i = 0; i < 8; ++i, bound *= step) {
        const double next = double(counts[i]);
        if (next < 0.5 * total) {
            if (i == 0) return bound / step; // less than the first bound, by no one knows how much
            const double part = (above - 0.5 * total) / std::max(above - next, 1.0);
            return bound * std::pow(step, part - 1.0);
        }
        above = next;
    }
    return bound / step;
}

class InputExaminer {
public:
    InputExaminer(const InputCheckSettings& s, const Camera& c, const InputStatistics& i)
        : settings(s), camera(c), statistics(i) {}

    std::vector<InputFinding> examine() {
        if (auto valid = cameraConstants(camera, settings.conventions, settings.resolution); !valid) {
            add(InputProblem::camera, Certainty::mistake, 0.0, valid.error().message);
            return std::move(findings);
        }
        examineDepth();
        if (surfaces() > 0.0) {
            examineDistances();
            examineNormals();
        }
        examineGeometry();
        if (surfaces() > 0.0) {
            examineAlbedo();
            examineLight();
            examineMotion();
        } else if (findings.empty()) {
            const double empty = value(ValueStatistic::depthEmpty) / std::max(pixels(), 1.0);
            addSuspicion(
                InputProblem::noSurfaces, empty,
                "no pixel holds a surface at 1e-6 to 1e7 m: depth is that of the sky at " + percent(empty) +
                    " of the pixels; unless the camera looks at nothing, depth was cleared or not written");
        }
        return std::move(findings);
    }

private:
    const InputCheckSettings& settings;
    const Camera& camera;
    const InputStatistics& statistics;
    std::vector<InputFinding> findings;

    const float* row(StatisticRow r) const { return statistics.data() + 16 * int(r); }
    double at(StatisticRow r, int i) const { return double(row(r)[i]); }
    double value(int i) const { return at(StatisticRow::values, i); }
    double pixels() const { return value(ValueStatistic::pixels); }
    double surfaces() const { return value(ValueStatistic::surfaces); }
    bool device() const { return settings.conventions.depthEncoding == DepthEncoding::device; }

    bool found(InputProblem p) const {
        return std::any_of(findings.begin(), findings.end(),
                           [p](const InputFinding& f) { return f.problem == p; });
    }
    // One finding a problem: the first.
    void add(InputProblem p, Certainty certainty, double measure, std::string sentence) {
        if (!found(p)) findings.push_back({p, certainty, measure, std::move(sentence)});
    }
    void addMistake(InputProblem p, double measure, std::string sentence) {
        add(p, Certainty::mistake, measure, std::move(sentence));
    }
    void addSuspicion(InputProblem p, double measure, std::string sentence) {
        add(p, Certainty::suspicion, measure, std::move(sentence));
    }

    void examineDepth() {
        const double total = std::max(pixels(), 1.0);
        const double notFinite = value(ValueStatistic::depthNotFinite) / total,
                     negative = value(ValueStatistic::depthNegative) / total,
                     above = value(ValueStatistic::depthAboveOne) / total;
        const double opposite = value(ValueStatistic::depthOpposite) / total;
        const bool reversed = settings.conventions.depthDirection == DepthDirection::reversed;
        if (notFinite > 0.0)
            addSuspicion(InputProblem::depthNotFinite, notFinite,
                         "depth is infinite or not a number at " + percent(notFinite) +
                             " of the pixels, which count as empty; finite values, and " +
                             (device() && !reversed ? "1" : "0") +
                             " where there is no surface, were expected");
        if (device() && negative + above > strayShare)
            addMistake(
                InputProblem::depthOutOfRange, negative + above,
                "depth is outside 0 to 1 at " + percent(negative + above) +
                    " of the pixels, but conventions.depthEncoding says device; probably it holds distances "
                    "(DepthEncoding::planar), or depth before it was mapped to 0 to 1");
        if (!device() && negative > strayShare)
            addMistake(InputProblem::depthNegative, negative,
                       "depth is negative at " + percent(negative) +
                           " of the pixels; distances in front of the camera were expected: probably it is "
                           "view-space z of "
                           "a camera that looks down -z, and wants its sign changed");
        if (device() && opposite > clearedShare)
            addMistake(InputProblem::depthDirection, opposite,
                       "depth is exactly " + std::string(reversed ? "1" : "0") + " at " + percent(opposite) +
                           " of the pixels, which is the near plane, since conventions.depthDirection says " +
                           (reversed ? "reversed" : "forward") + "; probably it is " +
                           (reversed ? "forward" : "reversed") +
                           " and that is the sky, or depth was never written");
    }

    // Do distances fit the camera, and a float?
    void examineDistances() {
        const double median =
            medianOf(row(StatisticRow::levels), surfaces(), firstDepthBound, depthBoundStep);
        const DepthPlanes planes = depthPlanes(camera, settings.conventions);
        const double outside = value(ValueStatistic::outsidePlanes) / surfaces();
        const std::string range =
            shortText(planes.nearDistance) + " to " + shortText(planes.farDistance) + " m";
        if (!device() && outside > planeShare) {
            addSuspicion(InputProblem::depthUnits, outside,
                         percent(outside) + " of the surfaces lie outside the camera's clipping planes, at " +
                             range + "; half of them are beyond " + shortText(median) +
                             " m: probably depth is in another unit than " +
                             "the camera, or conventions.depthEncoding should be device");
            return;
        }
        const bool perspective = settings.conventions.projection == Projection::perspective;
        // Games and films keep the near plane at a thousandth of what they show, or nearer the scene.
        if (!device() && perspective && planes.nearDistance > 0.0 &&
            median > farFromNearPlane * planes.nearDistance)
            addSuspicion(InputProblem::depthUnits, median,
                         "half of the surfaces are beyond " + shortText(median) + " m, which is " +
                             shortText(median / planes.nearDistance) +
                             " times the near plane's distance; less than " + shortText(farFromNearPlane) +
                             " times was expected: probably depth is in millimetres or centimetres and the "
                             "camera in metres");
        else if (median < 1e-3 || median > 1e5)
            addSuspicion(InputProblem::depthUnits, median,
                         "half of the surfaces are beyond " + shortText(median) +
                             " m, where 0.001 to 100000 m were expected: surfaces count from 1e-6 to 1e7 m "
                             "only; probably "
                             "the scene is in kilometres, or in millimetres");
    }
    static constexpr double farFromNearPlane = 1e5;

    void examineNormals() {
        const double notFinite = value(ValueStatistic::normalNotFinite) / surfaces(),
                     numbers = std::max(surfaces() - value(ValueStatistic::normalNotFinite), 1.0);
        const double notUnit = value(ValueStatistic::normalNotUnit) / numbers,
                     none = value(ValueStatistic::normalWithoutDirection) / numbers,
                     meanLength = value(ValueStatistic::normalLength) / numbers;
        const bool isSigned = settings.conventions.normalEncoding == NormalEncoding::signedUnit;
        if (notFinite > 0.0)
            addMistake(
                InputProblem::normalsNotFinite, notFinite,
                "normal is infinite or not a number at " + percent(notFinite) +
                    " of the surfaces, which count as empty; probably a vector of length 0 was normalised");
        if (notUnit <= lengthShare) return;
        const double unitOtherwise =
                         value(isSigned ? ValueStatistic::unitIfUnsigned : ValueStatistic::unitIfSigned) /
                         numbers,
                     isPositive = value(ValueStatistic::normalWithinZeroToOne) / numbers;
        const bool encoded = unitOtherwise > 0.9 && (!isSigned || isPositive > 0.99);
        if (encoded)
            addMistake(InputProblem::normalsEncoding, notUnit,
                       "normal has a length other than 1 at " + percent(notUnit) +
                           " of the surfaces when read as " + (isSigned ? "signedUnit" : "unsignedUnit") +
                           ", and a length of 1 at " + percent(unitOtherwise) + " when read as " +
                           (isSigned ? "unsignedUnit" : "signedUnit") +
                           "; probably conventions.normalEncoding should be that");
        else
            addMistake(InputProblem::normalsNotUnit, notUnit,
                       "normal has a length other than 1 at " + percent(notUnit) + " of the surfaces, " +
                           shortText(meanLength) + " on average, and no direction at " + percent(none) +
                           "; unit length was expected: probably normals are not normalised, or encoded in a "
                           "way that "
                           "conventions.normalEncoding does not know");
    }

    void examineGeometry();
    void examineFacing();
    void nameDepth(const GeometryReading& best, const std::string& evidence);
    void nameNormals(const GeometryReading& best, const std::string& evidence);
    void examineAlbedo();
    void examineLight();
    void examineLightValues(StatisticRow, const char* image, InputProblem notFinite, InputProblem negative,
                            InputProblem black);
    void examineAlbedoInRadiance();
    void examineMotion();
    void nameMotion(int reading, double stated, double share);
};

} // namespace rebound::detail
