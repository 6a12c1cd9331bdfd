// SPDX-License-Identifier: MIT
// Findings on albedo, light and motion. Thresholds and their reasons: docs/input_check.md.
#include "examiner.hpp"

namespace rebound {
namespace detail {

constexpr double uniformShare = 0.99;   // of surfaces with the same extreme value: the image holds nothing
constexpr double edgeMinimum = 100.0;   // votes; fewer decide nothing
constexpr double voteMajority = 0.6;    // of votes, where one third would be chance
constexpr double motionAgreeing = 0.7;  // of moving surfaces; the rest may be things that move
constexpr double motionExplained = 0.5; // of moving surfaces that another reading must explain
constexpr double motionGain = 0.3;      // and by how much more than what is stated

void InputExaminer::examineAlbedo() {
    if (!settings.albedo) return;
    const auto share = [&](int i) { return at(StatisticRow::albedo, i) / surfaces(); };
    if (share(AlbedoStatistic::notFinite) > 0.0)
        addMistake(InputProblem::albedoNotFinite, share(AlbedoStatistic::notFinite),
                   "albedo is infinite or not a number at " + percent(share(AlbedoStatistic::notFinite)) +
                       " of the surfaces; 0 to 1 was expected");
    const double outside = share(AlbedoStatistic::negative) + share(AlbedoStatistic::aboveOne);
    if (outside > strayShare)
        addMistake(
            InputProblem::albedoOutOfRange, outside,
            "albedo is below 0 or above 1 at " + percent(outside) + " of the surfaces, and " +
                shortText(share(AlbedoStatistic::sum)) +
                " on average; 0 to 1 was expected: probably it is in 0 to 255, or holds something else");
    for (int i : {AlbedoStatistic::white, AlbedoStatistic::black})
        if (share(i) > uniformShare)
            addSuspicion(InputProblem::albedoUniform, share(i),
                         std::string("albedo is ") + (i == AlbedoStatistic::white ? "1" : "0") + " at " +
                             percent(share(i)) + " of the surfaces; unless all is " +
                             (i == AlbedoStatistic::white ? "white" : "black") +
                             ", the image was cleared and never written");
}

void InputExaminer::examineLightValues(StatisticRow r, const char* image, InputProblem notFinite,
                                       InputProblem negative, InputProblem black) {
    const double total = std::max(at(r, LightStatistic::surfaces), 1.0);
    const auto share = [&](int i) { return at(r, i) / total; };
    if (share(LightStatistic::notFinite) > 0.0)
        addMistake(notFinite, share(LightStatistic::notFinite),
                   std::string(image) + " is infinite or not a number at " +
                       percent(share(LightStatistic::notFinite)) +
                       " of the surfaces, which neither send nor receive light; finite values were expected");
    if (share(LightStatistic::negative) > strayShare)
        addMistake(
            negative, share(LightStatistic::negative),
            std::string(image) + " is negative at " + percent(share(LightStatistic::negative)) +
                " of the surfaces; 0 or more was expected: probably a filter or a difference leaves it");
    if (share(LightStatistic::black) > uniformShare)
        addSuspicion(
            black, share(LightStatistic::black),
            std::string(image) + " is 0 at " + percent(share(LightStatistic::black)) +
                " of the surfaces; unless the scene is dark, the image was cleared and never written");
}

void InputExaminer::examineLight() {
    if (settings.lit)
        examineLightValues(StatisticRow::lit, "lit", InputProblem::litNotFinite, InputProblem::litNegative,
                           InputProblem::litBlack);
    if (!settings.radiance) return;
    examineLightValues(StatisticRow::radiance, "radiance", InputProblem::radianceNotFinite,
                       InputProblem::radianceNegative, InputProblem::radianceBlack);
    const double clipped = at(StatisticRow::radiance, LightStatistic::clipped) /
                           std::max(at(StatisticRow::radiance, LightStatistic::surfaces), 1.0);
    if (clipped > strayShare)
        addMistake(InputProblem::radianceClipped, clipped,
                   "radiance is 65504 or more at " + percent(clipped) +
                       " of the surfaces, which is where half floats end; probably the light is in a unit "
                       "that wants a smaller "
                       "exposure before it is stored");
    const double bright = at(StatisticRow::radiance, LightStatistic::surfaces) -
                          at(StatisticRow::radiance, LightStatistic::notFinite) -
                          at(StatisticRow::radiance, LightStatistic::black);
    const double median =
        medianOf(row(StatisticRow::levels) + 8, bright, firstRadianceBound, radianceBoundStep);
    if (bright > judgedShare * pixels() && (median < 1e-4 || median > 1e4))
        addSuspicion(InputProblem::radianceUnits, median,
                     "half of the surfaces that have light are brighter than " + shortText(median) +
                         ", where 0.0001 to 10000 was expected: half floats lose bits below 0.00006 and end "
                         "at 65504; probably "
                         "an exposure or a conversion of units is missing");
    if (settings.albedo && !found(InputProblem::albedoUniform) && !found(InputProblem::albedoOutOfRange))
        examineAlbedoInRadiance();
}

// Radiance of a diffuse surface is in proportion to its albedo.
void InputExaminer::examineAlbedoInRadiance() {
    const auto votes = [&](StatisticRow r, int i) {
        return at(r, i) / std::max(at(r, LightStatistic::edges), 1.0);
    };
    const double edges = at(StatisticRow::radiance, LightStatistic::edges);
    const double independent = votes(StatisticRow::radiance, LightStatistic::edgesWithoutAlbedo),
                 squared = votes(StatisticRow::radiance, LightStatistic::edgesWithSquare);
    if (edges >= edgeMinimum && independent > voteMajority) {
        const bool litFollows = settings.lit && at(StatisticRow::lit, LightStatistic::edges) >= edgeMinimum &&
                                votes(StatisticRow::lit, LightStatistic::edgesWithoutAlbedo) <= voteMajority;
        addMistake(InputProblem::radianceWithoutAlbedo, independent,
                   "radiance hardly changes where albedo does, at " + percent(independent) + " of " +
                       shortText(edges) + " edges between albedos" + (litFollows ? ", while lit does" : "") +
                       "; radiance in proportion to albedo was expected: probably it is irradiance, and "
                       "albedo is missing in it");
        return;
    }
    if (edges >= edgeMinimum && squared > voteMajority)
        addMistake(InputProblem::radianceAlbedoTwice, squared,
                   "radiance changes more than albedo does, nearer to its square, at " + percent(squared) +
                       " of " + shortText(edges) +
                       " edges between albedos; radiance in proportion to albedo was expected: probably it "
                       "was multiplied by albedo twice, or albedo is stored in sRGB");
    const double pairs = at(StatisticRow::radiance, LightStatistic::darkPairs),
                 shining = at(StatisticRow::radiance, LightStatistic::shiningPairs) / std::max(pairs, 1.0);
    if (pairs >= std::max(edgeMinimum, judgedShare * pixels()) && shining > voteMajority)
        addSuspicion(
            InputProblem::radianceSpecular, shining,
            "radiance of surfaces with an albedo below 0.02 is more than half of that of brighter surfaces "
            "nearby, at " +
                percent(shining) + " of " + shortText(pairs) +
                " pairs; nearly none was expected of diffuse light: probably specular light is in it" +
                (settings.emission ? "" : ", unless these surfaces emit light (settings.emission)"));
}

void InputExaminer::examineMotion() {
    if (!settings.motion) return;
    const auto r = [&](int i) { return at(StatisticRow::motion, i); };
    if (r(MotionStatistic::notFinite) > 0.0)
        addMistake(InputProblem::motionNotFinite, r(MotionStatistic::notFinite) / surfaces(),
                   "motion is infinite or not a number at " +
                       percent(r(MotionStatistic::notFinite) / surfaces()) +
                       " of the surfaces; finite values were expected");
    const double moving = r(MotionStatistic::moving), still = r(MotionStatistic::still);
    if (still > judgedShare * pixels() && still >= moving &&
        r(MotionStatistic::stillButMoved) > (1.0 - motionAgreeing) * still)
        addMistake(InputProblem::motionContradictsScene, r(MotionStatistic::stillButMoved) / still,
                   "motion is more than 2 pixels off at " +
                       percent(r(MotionStatistic::stillButMoved) / still) +
                       " of the surfaces that both cameras see at the same place; nearly none was expected "
                       "of a scene that "
                       "stands still: probably it is of another frame, or holds something else");
    if (moving <= judgedShare * pixels()) return;
    int best = 0;
    for (int i = 1; i < 12; ++i)
        if (r(MotionStatistic::agreements + i) > r(MotionStatistic::agreements + best)) best = i;
    const double stated = r(MotionStatistic::agreements) / moving,
                 share = r(MotionStatistic::agreements + best) / moving;
    if (stated < motionAgreeing && share > motionExplained && share > stated + motionGain)
        nameMotion(best, stated, share);
    else if (stated < 1.0 - motionAgreeing)
        addMistake(InputProblem::motionContradictsScene, stated,
                   "motion is what depth and the two cameras give at " + percent(stated) +
                       " of the surfaces; nearly all were expected of a scene that stands still: probably "
                       "motion leaves out the "
                       "camera, a camera is of another frame or jittered otherwise, or depth is in another "
                       "unit than the camera");
}

// Readings: three units, the stated first, each as it is, turned round, with y turned, with x turned.
void InputExaminer::nameMotion(int reading, double stated, double share) {
    constexpr const char* unitNames[] = {"pixels", "textureCoordinates", "normalizedDevice"};
    constexpr const char* signNames[] = {"as it is", "with its sign changed", "with y's sign changed",
                                         "with x's sign changed"};
    const std::string evidence = "motion is what depth and the two cameras give at " + percent(stated) +
                                 " of the surfaces as stated, and at " + percent(share);
    if (reading >= 4)
        addMistake(InputProblem::motionUnit, share,
                   evidence + " if read as " +
                       unitNames[int(motionUnits(settings.motionConventions.unit)[size_t(reading / 4)])] +
                       ", " + signNames[reading % 4] + "; probably motionConventions.unit should be that");
    if (reading % 4 != 0)
        addMistake(InputProblem::motionDirection, share,
                   evidence + " if read " + signNames[reading % 4] +
                       "; probably motionConventions.direction" +
                       (reading % 4 == 1 ? " is the other one" : " is right, and that axis is mirrored"));
}

} // namespace detail

std::vector<InputFinding> examineInputs(const InputCheckSettings& settings, const Camera& camera,
                                        const InputStatistics& statistics) {
    return detail::InputExaminer(settings, camera, statistics).examine();
}

} // namespace rebound
