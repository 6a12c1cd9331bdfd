// SPDX-License-Identifier: MIT
// Definitions of input_check.hpp: findings on depth and normals. Thresholds and their reasons:
// docs/input_check.md.

#include <cstdio>

namespace rebound {

inline const char* name(InputProblem problem) {
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

inline const char* describe(DepthMeaning meaning) {
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

inline const char* describe(NormalChange change) {
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

inline void InputExaminer::examineGeometry() {
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
inline void InputExaminer::examineFacing() {
    const double away = value(ValueStatistic::normalFacingAway) / std::max(surfaces(), 1.0);
    if (away > 0.5)
        addMistake(InputProblem::normalsFlipped, away,
                   "normal points away from the eye at " + percent(away) +
                       " of the surfaces; nearly none was expected: probably normals have the wrong sign, or "
                       "are of the "
                       "other space");
}

inline void InputExaminer::nameDepth(const GeometryReading& best, const std::string& evidence) {
    if (best.depth == 0) return;
    const DepthMeaning meaning = depthMeanings(settings.conventions)[size_t(best.depth)];
    addMistake(meaning == DepthMeaning::reversed ? InputProblem::depthDirection : InputProblem::depthEncoding,
               best.cosine,
               "depth: " + evidence + " where depth is read as " + describe(meaning) +
                   "; probably it is that");
}

inline void InputExaminer::nameNormals(const GeometryReading& best, const std::string& evidence) {
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
