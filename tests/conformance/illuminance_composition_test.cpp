// SPDX-License-Identifier: MIT
// Precomputed illuminance composition with bakes without a pattern, over several frames, on every backend of this machine:
// pass by pass against the scalar CPU.
#include "each_backend.hpp"
#include "random_bake.hpp"

#include "lab/conformance/conformance.hpp"
#include "rebound/techniques/illuminance_composition.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <limits>
#include <optional>

using namespace rebound;
using namespace rebound::test;

namespace {

constexpr Extent2D extent{37, 11}; // neither side is a multiple of lanes or groups
constexpr int frames = 4;

struct Variant {
    uint32_t bands;
    LinkForm form;
    uint32_t surfels, terms;
    bool bounces, emission, writeIndirect, compose;
    Projection projection;
    uint32_t mapCaches; // 0: grid alone
    bool skipUnchanged = false, emissionOfFrame = false;
    GlossyLobe glossy = GlossyLobe::none;
    std::optional<float> glossyExponent = 7.0f;
};

const Variant variants[] = {
    {2, LinkForm::coefficients, 1, 2, true, true, true, true, Projection::orthographic, 0},
    {3, LinkForm::coefficients, 130, 2, true, false, true, false, Projection::orthographic, 0},
    {4, LinkForm::coefficients, 75, 8, true, true, false, true, Projection::perspective, 0},
    {2, LinkForm::direction, 64, 3, false, true, true, true, Projection::perspective, 0},
    {3, LinkForm::direction, 300, 5, true, true, true, true, Projection::orthographic, 0},
    {4, LinkForm::direction, 33, 2, false, false, true, false, Projection::orthographic, 0},
    {3, LinkForm::coefficients, 90, 2, true, true, true, true, Projection::orthographic, 33},
    {4, LinkForm::coefficients, 40, 3, true, false, true, false, Projection::perspective, 12},
    {2, LinkForm::direction, 130, 2, false, true, false, true, Projection::perspective, 70},
    {3, LinkForm::coefficients, 700, 2, true, true, true, false, Projection::perspective, 0, true, false,
     GlossyLobe::mirror},
    {2, LinkForm::direction, 90, 4, false, true, true, false, Projection::orthographic, 0, true, true},
    {4, LinkForm::coefficients, 60, 3, true, true, false, false, Projection::orthographic, 0, false, true,
     GlossyLobe::halfVector, std::nullopt},
};

std::vector<float> lightOf(Numbers32& random, uint32_t surfels) {
    std::vector<float> light(3 * size_t(BakeLayout::stride(surfels)));
    for (float& l : light) l = random.within(0.0f, 4.0f);
    light[0] = std::numeric_limits<float>::quiet_NaN();
    light[light.size() / 2] = -1.0f;
    return light;
}

// Pixels everywhere in the grid and around it; some without a surface.
IlluminanceCompositionFrame<lab::Image> frameOf(Numbers32& random, const Bake& bake, const Variant& v) {
    IlluminanceCompositionFrame<lab::Image> frame;
    frame.camera.projection = v.projection == Projection::orthographic
                                  ? glm::ortho(-1.0f, 9.0f, -1.0f, 9.0f, 0.1f, 100.0f)
                                  : glm::perspective(1.2f, 1.5f, 0.1f, 100.0f);
    if (v.projection == Projection::perspective)
        frame.camera.view = glm::lookAt(glm::vec3(7, 8, 2), glm::vec3(4, 4, -4), glm::vec3(0.1f, 1, 0));
    frame.depth = lab::Image(extent, 1);
    frame.normal = frame.albedo = frame.lit = lab::Image(extent, 3);
    for (size_t i = 0; i < frame.depth.data.size(); ++i) {
        frame.depth.data[i] = random.below(30) == 0 ? 0.0f : random.within(0.05f, 9.0f);
        const glm::vec3 n = random.direction();
        for (size_t c = 0; c < 3; ++c) frame.normal.data[3 * i + c] = n[int(c)];
    }
    if (v.mapCaches > 0) {
        frame.mapPlace = lab::Image(extent, 2);
        for (float& place : frame.mapPlace.data) place = random.within(-1.0f, 8.0f);
        frame.mapPlace.data[8] = std::numeric_limits<float>::quiet_NaN();
        frame.mapPlace.data[11] = std::numeric_limits<float>::infinity();
    }
    for (float& a : frame.albedo.data) a = random.unit();
    for (float& l : frame.lit.data) l = random.within(0.0f, 2.0f);
    frame.normal.data[4] = std::numeric_limits<float>::quiet_NaN();
    frame.depth.data[5] = std::numeric_limits<float>::infinity();
    for (size_t s = 0; s < frame.sections.size(); ++s) frame.sections[s] = sharedBytes(bake.sections[s]);
    frame.surfelLight = sharedBytes(lightOf(random, v.surfels));
    frame.surfelEmission = sharedBytes(lightOf(random, v.surfels));
    frame.exponent = lab::Image(extent, 1);
    for (float& e : frame.exponent.data) e = random.within(0.0f, 20.0f);
    return frame;
}

std::vector<conformance::ImageTolerance> tolerancesOf(const Plan& plan) {
    constexpr double halfUlp = 1.0 / 1024.0;
    std::vector<conformance::ImageTolerance> tolerances;
    for (const Resource& r : plan.resources) {
        conformance::ImageTolerance t = conformance::toleranceOf(r.format);
        if (r.name == "caches")
            t.channels.fill({2e-5, 2e-5, "sums of eight links that cancel, of radiances up to 10"});
        if (r.name == "nodes")
            t.channels.fill(
                {1e-4, 1e-6,
                 "positions are rounded to 1e-6 cells, ramps are as steep as 6 a cell, and caches differ by "
                 "as much as they hold; areas are at most 2 over the number of surfels"});
        if (r.name == "kept" || r.name == "settled" || r.name == "settled parts")
            t.channels.fill({0.0, 0.0, "what the host has handed in, zeros and ones are exact"});
        if (r.kind == ResourceKind::output)
            t.channels.fill({2.0 * halfUlp, 2e-4, "rounding to halves, on top of what holds for nodes"});
        tolerances.push_back(t);
    }
    return tolerances;
}

conformance::NamedCase caseOf(size_t number) {
    return {"composition " + std::to_string(number), [number]() -> Result<conformance::Case> {
                const Variant& v = variants[number];
                Numbers32 random(uint32_t(number) + 40);
                const Bake bake =
                    randomBake(uint32_t(number) + 7, v.bands, v.form, v.surfels, v.terms, v.mapCaches).pack();
                IlluminanceCompositionSettings settings;
                settings.resolution = extent;
                settings.conventions.projection = v.projection;
                settings.bake = bake.layout;
                settings.bounces = v.bounces;
                settings.emission = v.emission;
                settings.lightMap = v.mapCaches > 0;
                settings.writeIndirect = v.writeIndirect;
                settings.compose = v.compose;
                settings.skipUnchanged = v.skipUnchanged;
                settings.emissionOfFrame = v.emissionOfFrame;
                settings.glossy = v.glossy;
                settings.glossyExponent = v.glossyExponent;
                auto plan = planIlluminanceComposition(settings);
                if (!plan) return plan.error();
                std::vector<runner::PlanInputs> inputs;
                IlluminanceCompositionFrame<lab::Image> given;
                for (int frame = 0; frame < frames; ++frame) {
                    // Where what does not change is skipped, the last frame is the one before it.
                    if (frame == 0 || frame + 1 < frames || !v.skipUnchanged)
                        given = frameOf(random, bake, v);
                    auto made = illuminanceCompositionInputs(settings, given);
                    if (!made) return made.error();
                    inputs.push_back(*made);
                }
                conformance::Case c{*plan, inputs[0], runner::Precision::single, {}, {}};
                c.tolerances = tolerancesOf(*plan);
                c.later.assign(inputs.begin() + 1, inputs.end());
                return c;
            }};
}

} // namespace

TEST_CASE("every backend lights surfels, nodes, caches and pixels alike, frame by frame") {
    std::vector<conformance::Contender> contenders;
    for (const runner::BackendChoice& choice : choices())
        if (auto backend = runner::createBackend(choice))
            contenders.push_back({runner::toText((*backend)->info()), *std::move(backend)});
    std::vector<conformance::NamedCase> cases;
    for (size_t i = 0; i < std::size(variants); ++i) cases.push_back(caseOf(i));
    const auto report = conformance::run(cases, contenders, {}, choices().front());
    REQUIRE_MESSAGE(report, (report ? "" : report.error().message));
    for (const conformance::Finding& f : report->disagreements)
        MESSAGE(f.contender << ": " << f.caseName << ", " << f.pass << ", " << f.resource);
    CHECK(report->agrees());
    for (const conformance::FrameRow& row : report->frames) {
        MESSAGE(row.contender << ": whole frames differ by " << row.maximum);
        CHECK(row.maximum < 1e-3); // rounding to halves on GPUs, over four bounces
    }
}
