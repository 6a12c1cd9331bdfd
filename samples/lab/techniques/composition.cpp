// SPDX-License-Identifier: MIT
#include "rebound/techniques/illuminance_composition.hpp"

#include "lab/baking/kept_bake.hpp"
#include "lab/baking/map_places.hpp"
#include "lab/baking/scene_geometry.hpp"
#include "lab/baking/surfel_light.hpp"
#include "lab/runner/shared_bytes.hpp"
#include "lab/scenes/camera_matrices.hpp"
#include "lab/techniques/bake_settings.hpp"
#include "lab/techniques/draft_values.hpp"
#include "rebound/bake/bake_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace rebound::techniques {

namespace {

constexpr std::pair<const char*, bool> switchNames[] = {{"on", true}, {"off", false}};
constexpr std::pair<const char*, bool> carrierNames[] = {{"lightmap", true}, {"grid", false}};

// Light of 8 bounces is settled after as many frames; what comes then is less than the eye sees.
constexpr int settledBounces = 12;

struct Choice {
    BakeSettings bake;
    std::string file;         // empty: baked
    std::optional<Bake> read; // from that file
    bool bounces = true;
    bool skipUnchanged = false;
    bool lightMap = true; // where the bake has one
    View view;
};

Result<Choice> choiceOf(const Draft& draft, const View& view, Spelling spelling) {
    auto settings = bakeSettingsOf(draft, spelling);
    if (!settings) return settings.error();
    Choice choice{*settings, {}, {}, true, false, true, view};
    DraftValues values(draft, spelling);
    values.replaceByName<bool>(choice.bounces, "feedback", switchNames);
    values.replaceByName<bool>(choice.skipUnchanged, "skip-unchanged", switchNames);
    values.replaceByName<bool>(choice.lightMap, "static-light", carrierNames);
    if (!values.error()) return values.error().error();
    const std::string* file = values.find("bake");
    if (!file) return choice;
    if (file->empty()) return invalidArgument(values.called("bake") + " is empty; a file was expected");
    for (const Option& option : bakeOptions())
        if (values.find(option.name))
            return invalidArgument(values.called(option.name) + " was given with " + values.called("bake") +
                                   ", whose file says it already");
    choice.file = *file;
    auto bake = readBake(choice.file);
    if (!bake) return bake.error();
    choice.read = *std::move(bake);
    return choice;
}

void setLikelyMap(BakeLayout& layout, uint32_t caches) {
    if (caches == 0) return;
    layout.surfaceCaches = caches;
    // Charts have a texel around, and lie next to each other with gaps.
    layout.mapSize = glm::uvec2(std::min(2046u, 3u + uint32_t(std::sqrt(2.0 * double(caches)))));
    layout.mapTriangles = 1;
    layout.mapTexel = 1.0f;
}

// As large as a bake with these settings becomes at most, or nearly so.
BakeLayout likelyLayout(const BakeSettings& s) {
    BakeLayout layout;
    layout.surfels = s.surfels;
    layout.nodes = 2 * s.surfels - 1;
    layout.caches = s.caches + s.lightMap;
    setLikelyMap(layout, s.lightMap);
    layout.links = s.links;
    layout.bands = s.bands;
    layout.linkForm = s.linkForm;
    layout.cells = s.caches;
    // Surfaces pass through a few of a brick's 64 cells.
    const uint32_t side = std::clamp(uint32_t(std::ceil(std::cbrt(double(s.caches) / 8.0))), 1u, 256u);
    layout.bricks = glm::uvec3(side);
    layout.filledBricks = std::min(side * side * side, s.caches);
    layout.receivers = 8 * s.caches;
    if (layout.nodes > layout.surfels) {
        layout.stages = 1;
        layout.stage[0] = {layout.surfels, layout.nodes - layout.surfels, 2, 0};
    }
    return layout;
}

IlluminanceCompositionSettings settingsOf(const Choice& choice, const BakeLayout& layout, bool emission) {
    IlluminanceCompositionSettings settings;
    settings.resolution = choice.view.size;
    settings.conventions.projection = choice.view.projection;
    settings.bake = layout;
    settings.bounces = choice.bounces;
    settings.skipUnchanged = choice.skipUnchanged;
    settings.emission = emission;
    settings.lightMap = choice.lightMap && layout.surfaceCaches > 0;
    return settings;
}

Json settingsJson(const Choice& choice) {
    Json json = choice.file.empty() ? toJson(choice.bake) : Json{{"bake", choice.file}};
    json["feedback"] = choice.bounces;
    json["skipUnchanged"] = choice.skipUnchanged;
    json["static_light"] = choice.lightMap ? "lightmap" : "grid";
    return json;
}

std::string nameOf(const Choice& choice) {
    return "composition, " + (choice.file.empty() ? techniques::nameOf(choice.bake) : choice.file) +
           (choice.bounces ? "" : ", one bounce") + (choice.lightMap ? "" : ", grid alone") +
           (choice.skipUnchanged ? ", unchanged light skipped" : "");
}

Result<Configured> withoutInputs(const Choice& choice, const BakeLayout& layout, bool emission) {
    auto plan = planIlluminanceComposition(settingsOf(choice, layout, emission));
    if (!plan) return plan.error();
    Configured configured;
    configured.settings = settingsJson(choice);
    configured.name = nameOf(choice);
    configured.description = configured.name;
    configured.plan = *std::move(plan);
    configured.settlingFrames = choice.bounces ? settledBounces : 1;
    return configured;
}

// Rays need the scene as long as they are cast.
struct SceneWithRays {
    std::shared_ptr<const lab::Scene> scene;
    lab::EmbreeScene rays;
};

Result<std::shared_ptr<const lab::EmbreeScene>> raysOf(std::shared_ptr<const lab::Scene> scene) {
    auto rays = lab::EmbreeScene::build(*scene);
    if (!rays) return rays.error();
    const auto both =
        std::make_shared<const SceneWithRays>(SceneWithRays{std::move(scene), *std::move(rays)});
    return std::shared_ptr<const lab::EmbreeScene>(both, &both->rays);
}

// What stays the same from frame to frame.
struct BakedScene {
    Bake bake;
    std::array<SharedBytes, bakeSectionCount> sections;
    SharedBytes surfelLight;
};

Result<lab::ObtainedBake> obtainBake(const Choice& choice, std::shared_ptr<const lab::EmbreeScene> rays,
                                     const Surroundings& surroundings) {
    if (choice.read) {
        if (choice.read->layout.geometry != fingerprintOf(lab::geometryOf(std::move(rays))))
            return invalidArgument(choice.file + " is the bake of another scene than " +
                                   surroundings.scene->name + "; rebound bake makes one of it");
        return lab::ObtainedBake{*choice.read, choice.file, 0.0};
    }
    BakeSettings settings = choice.bake;
    settings.threads = surroundings.threads;
    settings.progress = surroundings.progress;
    return lab::keptBake(std::move(rays), settings, lab::bakeFolder());
}

std::string noteOn(const lab::ObtainedBake& obtained) {
    char text[48];
    std::snprintf(text, sizeof text, "the scene was baked in %.1f s", obtained.seconds);
    return (obtained.seconds > 0.0 ? std::string(text) + " and kept as " : "the bake was taken from ") +
           obtained.file.string();
}

Result<Configured> bakedIn(const Choice& choice, const Surroundings& surroundings) {
    auto rays = raysOf(surroundings.scene);
    if (!rays) return rays.error();
    auto obtained = obtainBake(choice, *rays, surroundings);
    if (!obtained) return obtained.error();
    const bool emission = !surroundings.scene->emissiveMaterialsLight;
    auto configured = withoutInputs(choice, obtained->bake.layout, emission);
    if (!configured) return configured.error();
    configured->notes.push_back(noteOn(*obtained));

    const auto baked = std::make_shared<BakedScene>();
    baked->bake = obtained->bake;
    for (size_t i = 0; i < baked->sections.size(); ++i)
        baked->sections[i] = runner::sharedBytes(obtained->bake.sections[i]);
    lab::SurfelLightOptions light;
    light.threads = surroundings.threads;
    std::vector<float> planes = lab::directLightOnSurfels(obtained->bake, **rays, light);
    baked->surfelLight = runner::sharedBytes(planes);
    configured->bake =
        std::make_shared<const lab::LitBake>(lab::LitBake{obtained->bake, std::move(planes), emission});

    const IlluminanceCompositionSettings settings = settingsOf(choice, baked->bake.layout, emission);
    configured->inputs = [settings, baked, rays = *rays, threads = surroundings.threads](
                             const lab::Frame& frame, const lab::Image&, const lab::Image& lit) {
        IlluminanceCompositionFrame<lab::Image> inputs;
        inputs.camera = lab::cameraMatrices(frame.camera, settings.resolution);
        inputs.depth = frame.depth;
        inputs.normal = frame.normal;
        if (settings.lightMap) inputs.mapPlace = lab::mapPlacesOf(baked->bake, *rays, frame, threads);
        inputs.albedo = frame.albedo;
        inputs.lit = lit;
        inputs.sections = baked->sections;
        inputs.surfelLight = baked->surfelLight;
        return illuminanceCompositionInputs(settings, inputs);
    };
    return configured;
}

Result<Configured> configuredFor(const Choice& choice) {
    auto configured =
        withoutInputs(choice, choice.read ? choice.read->layout : likelyLayout(choice.bake), true);
    if (!configured) return configured.error();
    configured->inScene = [choice](const Surroundings& surroundings) {
        return bakedIn(choice, surroundings);
    };
    return configured;
}

Result<Configured> parse(const Draft& draft, const View& view, Spelling spelling) {
    const auto choice = choiceOf(draft, view, spelling);
    if (!choice) return choice.error();
    return configuredFor(*choice);
}

// Settings that leave less of one approximation each, on top of those before them; more would take minutes to bake.
Result<std::vector<Ablation>> ablations(const Draft& draft, const View& view) {
    const auto given = choiceOf(draft, view, Spelling::options);
    if (!given) return given.error();
    if (!given->file.empty()) return std::vector<Ablation>{};
    Choice choice = *given;
    std::vector<Ablation> steps;
    const auto add = [&](const char* name, const std::string& meaning) -> Result<> {
        auto without = configuredFor(choice);
        if (!without) return without.error();
        steps.push_back({name, meaning, *std::move(without)});
        return {};
    };
    choice.bake.bands = 4;
    if (auto added = add("bands", "bands of spherical harmonics -> 4"); !added) return added.error();
    choice.bake.links = std::min(2 * choice.bake.links, 4096u);
    choice.bake.raysPerLink = std::min(2 * choice.bake.raysPerLink, 1024u);
    if (auto added = add("links", "links -> twice as many, each with twice the rays"); !added)
        return added.error();
    choice.bake.caches = std::min(4 * choice.bake.caches, 1u << 24);
    choice.bake.lightMap = std::min(4 * choice.bake.lightMap, 1u << 20);
    choice.bake.spacing *= 0.63f; // a quarter of the cells' volume
    if (auto added = add("interpolation", "caches -> 4 times as many"); !added) return added.error();
    return steps;
}

std::vector<Option> options() {
    std::vector<Option> all = {
        {"bake", "FILE", "what rebound bake has written (default: the scene is baked, and the bake kept)"},
        {"feedback", "SWITCH",
         "surfels receive light of the caches of the frame before, a bounce a frame:\non or off (default: "
         "on)"},
        {"skip-unchanged", "SWITCH",
         "light that did not change is not computed again; the same picture: on or off (default: off)"},
    };
    all.push_back({"static-light", "WHICH",
                   "what lights what stands where it was baked, of bakes that have both: lightmap or grid\n"
                   "(default: lightmap)"});
    for (Option& option : bakeOptions()) all.push_back(std::move(option));
    return all;
}

} // namespace

Technique composition() {
    Technique technique;
    technique.name = "composition";
    technique.heading = "Precomputed illuminance composition";
    technique.options = options();
    technique.parse = parse;
    technique.ablations = ablations;
    technique.lastApproximation = {"caches and patches",
                                   "caches lit through patches -> rays from every pixel to surfels"};
    technique.examples = {{{"surfels", "2000"}, {"caches", "800"}, {"links", "32"}},
                          {{"surfels", "2000"}, {"caches", "300"}, {"links", "32"}, {"lightmap", "1500"}}};
    return technique;
}

} // namespace rebound::techniques
