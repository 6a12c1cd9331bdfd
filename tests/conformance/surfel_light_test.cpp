// SPDX-License-Identifier: MIT
// Light on surfels on every backend of this machine: pass by pass against the scalar CPU, and against the lab's, which casts
// rays where an engine looks into its shadow maps.
#include "each_backend.hpp"
#include "random_bake.hpp"

#include "lab/baking/bake_of_scene.hpp"
#include "lab/baking/surfel_light.hpp"
#include "lab/conformance/conformance.hpp"
#include "lab/scenes/scene_files.hpp"
#include "rebound/techniques/surfel_light.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>

using namespace rebound;
using namespace rebound::test;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Sources of every kind, half of them with up to three views of maps in which depth is one of a few numbers.
SurfelLightFrame<lab::Image> randomFrame(Numbers32& random, const Bake& bake,
                                         const SurfelLightSettings& settings) {
    SurfelLightFrame<lab::Image> frame;
    frame.sources = settings.maximumSources - 1;
    std::vector<LightSource> sources(size_t(settings.maximumSources));
    std::vector<ShadowView> views(size_t(settings.maximumShadowViews));
    int view = 0;
    for (int i = 0; i < settings.maximumSources; ++i) {
        LightSource& s = sources[size_t(i)];
        s.position = glm::vec4(random.vector(-1.0f, 9.0f), 0.0f);
        s.direction = glm::vec4(random.direction(), random.within(0.0f, 0.7f));
        s.intensity = glm::vec4(random.vector(0.0f, 8.0f), random.within(0.7f, 1.0f));
        s.kind = {i % 5, view, settings.shadowMaps.empty() ? 0 : int(random.below(4)), 0};
        view += s.kind.z;
    }
    for (ShadowView& v : views) {
        const int map =
            settings.shadowMaps.empty() ? 0 : int(random.below(uint32_t(settings.shadowMaps.size())));
        const glm::vec3 eye = random.vector(-1.0f, 9.0f);
        const glm::mat4 look = glm::lookAtRH(eye, eye + random.direction(), glm::vec3(0.1f, 1, 0));
        const glm::mat4 projection = random.below(2) == 0
                                         ? glm::orthoRH_ZO(-5.0f, 5.0f, -5.0f, 5.0f, 0.1f, 20.0f)
                                         : glm::perspectiveRH_ZO(1.6f, 1.0f, 0.1f, 20.0f);
        v = shadowView(projection * look, {}, {map, {1, 2}, {9, 7}, random.within(0.0f, 0.2f)});
    }
    for (size_t i = 0; i < settings.shadowMaps.size(); ++i) {
        frame.shadowMaps[i] = lab::Image(settings.shadowMaps[i], 1);
        for (float& d : frame.shadowMaps[i].data) d = 0.2f * float(random.below(6));
    }
    frame.surfels = sharedBytes(bake.section(BakeSection::surfels));
    frame.lightSources = sharedBytes(sources);
    frame.shadowViews = sharedBytes(views);
    return frame;
}

conformance::NamedCase caseOf(size_t maps) {
    return {"surfel light, " + std::to_string(maps) + " maps", [maps]() -> Result<conformance::Case> {
                Numbers32 random(uint32_t(maps) + 3);
                const Bake bake = randomBake(uint32_t(maps) + 50, 3, LinkForm::coefficients, 150, 2).pack();
                SurfelLightSettings settings;
                settings.surfels = 150;
                settings.maximumSources = 11;
                settings.maximumShadowViews = 20;
                settings.placesPerSurfel = int(maps) * 2 + 1;
                settings.shadowMaps.assign(maps, {11, 10});
                auto plan = planSurfelLight(settings);
                if (!plan) return plan.error();
                auto inputs = surfelLightInputs(settings, randomFrame(random, bake, settings));
                if (!inputs) return inputs.error();
                conformance::Case c{*plan, *inputs, runner::Precision::single, {}, {}};
                for (const Resource& r : plan->resources) {
                    conformance::ImageTolerance t = conformance::toleranceOf(r.format);
                    t.channels.fill({1e-5, 1e-6, "sums of eleven lights, inverse square roots to 5e-7"});
                    c.tolerances.push_back(t);
                }
                return c;
            }};
}

// Depth as seen from a light, by rays.
lab::Image depthFrom(const lab::EmbreeScene& scene, const glm::mat4& worldToClip, Extent2D extent) {
    lab::Image map(extent, 1);
    const glm::dmat4 back = glm::inverse(glm::dmat4(worldToClip));
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const auto at = [&](double depth) {
                const glm::dvec4 p = back * glm::dvec4((x + 0.5) / extent.width * 2.0 - 1.0,
                                                       (y + 0.5) / extent.height * 2.0 - 1.0, depth, 1.0);
                return glm::dvec3(p) / p.w;
            };
            const glm::dvec3 from = at(0.0), to = at(1.0);
            const glm::vec3 direction(glm::normalize(to - from));
            const auto hit =
                scene.intersect({glm::vec3(from), direction, 0.0f, float(glm::length(to - from))});
            *map.at(x, y) = 1.0f;
            if (!hit) continue;
            const glm::dvec4 clip =
                glm::dmat4(worldToClip) * glm::dvec4(glm::dvec3(hit->point.position), 1.0);
            *map.at(x, y) = float(clip.z / clip.w);
        }
    return map;
}

glm::mat4 lookFrom(glm::vec3 eye, glm::vec3 direction) {
    return glm::lookAtRH(eye, eye + direction,
                         std::abs(direction.y) > 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0));
}

} // namespace

TEST_CASE("every backend lights surfels alike") {
    std::vector<conformance::Contender> contenders;
    for (const runner::BackendChoice& choice : choices())
        if (auto backend = runner::createBackend(choice))
            contenders.push_back({runner::toText((*backend)->info()), *std::move(backend)});
    std::vector<conformance::NamedCase> cases;
    for (size_t maps = 0; maps <= 4; ++maps) cases.push_back(caseOf(maps));
    const auto report = conformance::run(cases, contenders, {}, choices().front());
    REQUIRE_MESSAGE(report, (report ? "" : report.error().message));
    for (const conformance::Finding& f : report->disagreements)
        MESSAGE(f.contender << ": " << f.caseName << ", " << f.pass << ", " << f.resource);
    CHECK(report->agrees());
}

TEST_CASE("surfels receive what the lab's rays say, of a sun, a spot and a point source with six views") {
    lab::Scene scene = lab::makeCornellBox();
    lab::Light sun, spot, lamp;
    sun.direction = glm::normalize(glm::vec3(0.4f, -0.5f, -1.0f)); // through the open front
    sun.intensity = {3.0f, 2.0f, 1.0f};
    spot.type = lab::LightType::spot;
    spot.position = {0.5f, 5.3f, 0.0f};
    spot.direction = glm::normalize(glm::vec3(-0.5f, -1.0f, -0.2f));
    spot.intensity = glm::vec3(60.0f);
    spot.innerCone = 0.3f;
    spot.outerCone = 0.6f;
    lamp.type = lab::LightType::point;
    lamp.position = {2.0f, 2.5f, 1.5f};
    lamp.intensity = {4.0f, 8.0f, 12.0f};
    scene.lights = {sun, spot, lamp};
    auto built = lab::EmbreeScene::build(scene);
    REQUIRE(built);
    const auto rays = std::make_shared<const lab::EmbreeScene>(*std::move(built));
    BakeSettings small;
    small.surfels = 3000;
    small.caches = 100;
    small.links = 4;
    const auto bake = lab::bakeOfScene(rays, small);
    REQUIRE_MESSAGE(bake, (bake ? "" : bake.error().message));
    lab::SurfelLightOptions many;
    many.places = 64;
    const std::vector<float> expected = lab::directLightOnSurfels(*bake, *rays, many);

    SurfelLightSettings settings;
    settings.surfels = bake->layout.surfels;
    settings.placesPerSurfel = 16;
    settings.maximumShadowViews = 8;
    constexpr int side = 256;
    settings.shadowMaps = {{side, side}, {side, side}, {6 * side, side}};
    SurfelLightFrame<lab::Image> frame;
    frame.sources = 3;
    std::vector<LightSource> sources(size_t(settings.maximumSources));
    sources[0] = {{}, glm::vec4(sun.direction, 0), glm::vec4(sun.intensity, 0), {directionalSource, 0, 1, 0}};
    sources[1] = {glm::vec4(spot.position, 0),
                  glm::vec4(spot.direction, std::cos(spot.outerCone)),
                  glm::vec4(spot.intensity, std::cos(spot.innerCone)),
                  {spotSource, 1, 1, 0}};
    sources[2] = {glm::vec4(lamp.position, 0), {}, glm::vec4(lamp.intensity, 0), {pointSource, 2, 6, 0}};
    const glm::vec3 middle(0.0f, 2.7f, 0.0f);
    std::vector<ShadowView> views;
    const auto addView = [&](const glm::mat4& matrix, ShadowMapTile tile) {
        views.push_back(shadowView(matrix, {}, tile));
        const lab::Image part = depthFrom(*rays, matrix, {side, side});
        lab::Image& map = frame.shadowMaps[size_t(tile.map)];
        if (map.data.empty()) map = lab::Image(settings.shadowMaps[size_t(tile.map)], 1);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) *map.at(tile.first.x + x, y) = *part.at(x, y);
    };
    addView(glm::orthoRH_ZO(-6.0f, 6.0f, -6.0f, 6.0f, 0.0f, 24.0f) *
                lookFrom(middle - 12.0f * sun.direction, sun.direction),
            {0, {0, 0}, {side, side}});
    addView(glm::perspectiveRH_ZO(1.3f, 1.0f, 0.05f, 20.0f) * lookFrom(spot.position, spot.direction),
            {1, {0, 0}, {side, side}});
    const glm::vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face)
        addView(glm::perspectiveRH_ZO(0.5f * pi, 1.0f, 0.05f, 20.0f) * lookFrom(lamp.position, axes[face]),
                {2, {side * face, 0}, {side, side}});
    frame.surfels = sharedBytes(bake->section(BakeSection::surfels));
    frame.lightSources = sharedBytes(sources);
    frame.shadowViews = sharedBytes(views);
    const auto inputs = surfelLightInputs(settings, frame);
    REQUIRE(inputs);
    onEachBackend([&](runner::Backend& backend) {
        const auto prepared = prepare(backend, *planSurfelLight(settings), *inputs);
        run(*prepared, *inputs);
        const std::vector<float> light = read(*prepared, "surfel light");
        double sum = 0.0, difference = 0.0, bias = 0.0;
        int lit = 0, near = 0;
        const size_t stride = BakeLayout::stride(settings.surfels);
        for (size_t c = 0; c < 3; ++c)
            for (size_t i = 0; i < settings.surfels; ++i) {
                const double right = expected[c * stride + i], off = light[c * stride + i] - right;
                sum += right;
                difference += std::abs(off);
                bias += off;
                if (right <= 0.0) continue;
                ++lit;
                near += std::abs(off) < 0.03 * right ? 1 : 0;
            }
        MESSAGE("mean " << sum / double(3 * settings.surfels) << ", differences " << difference / sum
                        << " of it, bias " << bias / sum << ", within 3 %: " << double(near) / double(lit));
        // Shadows' edges lie within the texels' width, 3 cm, and 1.5 of it are cut off where surfaces meet.
        CHECK(difference < 0.04 * sum);
        CHECK(std::abs(bias) < 0.01 * sum);
        CHECK(near > 0.8 * lit);
    });
}
