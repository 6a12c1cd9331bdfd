// SPDX-License-Identifier: MIT
// Findings on depth and normals by the geometry that both give.
#include "examiner.hpp"

namespace rebound {

const char* name(InputProblem problem) {
    constexpr std::array names{"camera",
                               "noSurfaces",
                               "depthNotFinite",
                               "depthNegative",
                               "depthOutOfRange",
                               "depthDirection",
                               "depthEncoding",
                               "depthUnits",
                               "normalsNotFinite",
                               "normalsNotUnit",
                               "normalsEncoding",
                               "normalsSpace",
                               "normalsFlipped",
                               "normalsContradictDepth",
                               "albedoNotFinite",
                               "albedoOutOfRange",
                               "albedoUniform",
                               "radianceNotFinite",
                               "radianceNegative",
                               "radianceClipped",
                               "radianceBlack",
                               "radianceUnits",
                               "radianceWithoutAlbedo",
                               "radianceAlbedoTwice",
                               "radianceSpecular",
                               "litNotFinite",
                               "litNegative",
                               "litBlack",
                               "motionNotFinite",
                               "motionUnit",
                               "motionDirection",
                               "motionContradictsScene"};
    static_assert(names.size() == size_t(InputProblem::motionContradictsScene) + 1);
    return names[size_t(problem)];
}

namespace detail {
namespace {

const char* describe(DepthMeaning meaning) {
    switch (meaning) {
    case DepthMeaning::stated:
        return "as stated";
    case DepthMeaning::reversed:
        return "device depth of the other depthDirection";
    case DepthMeaning::otherRange:
        return "device depth of the other depthRange";
    case DepthMeaning::planar:
        return "a distance along the viewing axis (or one divided by the far plane's), DepthEncoding::planar";
    case DepthMeaning::radial:
        return "a distance along each pixel's ray, which wants to be multiplied by the cosine between ray "
               "and viewing axis";
    case DepthMeaning::device:
        return "device depth, DepthEncoding::device";
    case DepthMeaning::deviceMinusOne:
        return "device depth of range minusOneToOne, DepthEncoding::device";
    case DepthMeaning::deviceReversed:
        return "device depth that runs the other way, DepthEncoding::device";
    }
    return "?";
}

const char* describe(NormalChange change) {
    switch (change) {
    case NormalChange::none:
        return "as it is";
    case NormalChange::negated:
        return "with its sign changed: normals point into the surfaces";
    case NormalChange::viewX:
        return "with view-space x mirrored: normals or the projection have x the other way";
    case NormalChange::viewY:
        return "with view-space y mirrored: conventions.firstRow or the projection's y is the other way, or "
               "that of normals";
    case NormalChange::viewZ:
        return "with view-space z mirrored: normals are of the other handedness";
    case NormalChange::worldX:
        return "with world-space x mirrored";
    case NormalChange::worldY:
        return "with world-space y mirrored";
    case NormalChange::worldZ:
        return "with world-space z mirrored: normals and camera.view are of different handedness";
    case NormalChange::transposed:
        return "turned by the inverse of camera.view: camera.view is probably view to world, or transposed";
    case NormalChange::zUp:
        return "with world-space y and z exchanged: normals are of a world with z up, camera.view of one "
               "with y up";
    case NormalChange::zUpNegated:
        return "with world-space y and z exchanged: normals are of a world with y up, camera.view of one "
               "with z up";
    }
    return "?";
}

} // namespace

void InputExaminer::examineGeometry() {
    if (found(InputProblem::depthNegative)) return; // no reading that is tried takes it for what it is
    const std::vector<GeometryReading> readings = geometryReadings(settings, camera, statistics);
    const GeometryReading best = explain(readings);
    double stated = 0.0;
    for (const GeometryReading& r : readings)
        if (r.changes == 0) stated = r.cosine;
    const auto rowOf = [&](int depth) {
        return GeometryRow{row(StatisticRow(int(StatisticRow::geometry0) + depth))};
    };
    if (rowOf(best.depth).judged() < judgedShare * pixels()) {
        examineFacing();
        return;
    }
    const std::string evidence = "normals agree with the surfaces that depth describes to a mean cosine of " +
                                 shortText(stated) + ", and of " + shortText(best.cosine);
    if (best.changes > 0 && 1.0 - stated > agreeingResidual && best.cosine > explainedCosine) {
        nameDepth(best, evidence);
        nameNormals(best, evidence);
    } else if (stated < contradictingCosine) {
        addMistake(InputProblem::normalsContradictDepth, stated,
                   "normals agree with the surfaces that depth describes to a mean cosine of " +
                       shortText(stated) +
                       ", where about 1 was expected, and no other reading of either explains it; probably "
                       "they are of "
                       "another picture, camera or size, or the camera is not the one that rendered them");
    }
}

// Where surfaces are too small for neighbouring pixels to show how they lie, their normals must face the eye
// at least.
void InputExaminer::examineFacing() {
    const double away = value(ValueStatistic::normalFacingAway) / std::max(surfaces(), 1.0);
    if (away > 0.5)
        addMistake(InputProblem::normalsFlipped, away,
                   "normal points away from the eye at " + percent(away) +
                       " of the surfaces; nearly none was expected: probably normals have the wrong sign, or "
                       "are of the "
                       "other space");
}

void InputExaminer::nameDepth(const GeometryReading& best, const std::string& evidence) {
    if (best.depth == 0) return;
    const DepthMeaning meaning = depthMeanings(settings.conventions)[size_t(best.depth)];
    addMistake(meaning == DepthMeaning::reversed ? InputProblem::depthDirection : InputProblem::depthEncoding,
               best.cosine,
               "depth: " + evidence + " where depth is read as " + describe(meaning) +
                   "; probably it is that");
}

void InputExaminer::nameNormals(const GeometryReading& best, const std::string& evidence) {
    const NormalReading& n = best.normal;
    const GBufferConventions& c = settings.conventions;
    if (n.encoding != c.normalEncoding)
        addMistake(InputProblem::normalsEncoding, best.cosine,
                   "normal: " + evidence + " where it is read as " +
                       (n.encoding == NormalEncoding::signedUnit ? "signedUnit" : "unsignedUnit") +
                       "; probably conventions.normalEncoding should be that");
    if (n.space != c.normalSpace)
        addMistake(InputProblem::normalsSpace, best.cosine,
                   "normal: " + evidence + " where it is read as one of " +
                       (n.space == NormalSpace::world ? "world" : "view") +
                       " space; probably conventions.normalSpace should be that");
    if (n.change == NormalChange::none) return;
    const bool isSpace = n.change == NormalChange::transposed || n.change == NormalChange::zUp ||
                         n.change == NormalChange::zUpNegated;
    addMistake(isSpace ? InputProblem::normalsSpace : InputProblem::normalsFlipped, best.cosine,
               "normal: " + evidence + " where it is read " + describe(n.change));
}

} // namespace detail
} // namespace rebound
