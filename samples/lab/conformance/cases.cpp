// SPDX-License-Identifier: MIT
#include "lab/conformance/cases.hpp"

#include "lab/conformance/gbuffer.hpp"
#include "lab/rays/frame.hpp"
#include "lab/runner/texels.hpp"

#include <algorithm>
#include <limits>

namespace rebound::conformance {
namespace {

using runner::Precision;

ScreenIndirectSettings randomSettings(Random& random) {
    ScreenIndirectSettings s;
    s.resolution = {random.integer(1, 160), random.integer(1, 120)};
    const std::vector<GBufferConventions> conventions = lab::everyConvention();
    s.conventions = conventions[size_t(random.integer(0, int(conventions.size()) - 1))];
    s.start = StartResolution(random.integer(0, 2));
    s.levels = random.integer(1, 8);
    s.samplesPerLevel = random.integer(4, random.chance(0.2) ? 256 : 64);
    s.ringRadius = float(random.betweenDecades(1.0, 200.0));
    s.coverScreen = random.chance(0.5);
    s.reduction = Reduction(random.integer(0, 1));
    s.formFactor = FormFactor(random.integer(0, 1));
    s.minimumCosine = float(random.betweenDecades(0.001, 1.0));
    s.smooth = random.chance(0.5);
    s.compose = random.chance(0.7);
    s.writeIndirect = !s.compose || random.chance(0.6);
    if (random.chance(0.15)) s.onlyLevel = random.integer(0, s.levels - 1);
    return s;
}

Result<Case> randomCase(uint64_t seed) {
    Random random(seed);
    const ScreenIndirectSettings settings = randomSettings(random);
    GBufferOptions options;
    options.patches = random.integer(1, 16);
    options.skyShare = random.chance(0.3) ? 0.5 : 0.1;
    options.scale = random.betweenDecades(0.01, 100.0);
    options.radianceDecades = random.between(0.0, 3.0);
    const GBuffer g = makeGBuffer(settings, options, random);
    return caseOf(g, random.chance(0.5) ? Precision::half : Precision::single);
}

ScreenIndirectSettings settingsFor(Extent2D resolution) {
    ScreenIndirectSettings s;
    s.resolution = resolution;
    s.ringRadius = 12.0f;
    s.levels = 5;
    return s;
}

using Spoil = std::function<void(GBuffer&, Random&)>;

NamedCase hardCase(const std::string& name, Extent2D extent, const GBufferOptions& options,
                   const Spoil& spoil = {}) {
    return {name, [=]() -> Result<Case> {
                Random random(7);
                GBuffer g = makeGBuffer(settingsFor(extent), options, random);
                if (spoil) spoil(g, random);
                return caseOf(g, Precision::single);
            }};
}

void sprinkleNonNumbers(GBuffer& g, Random& random) {
    constexpr float values[] = {std::numeric_limits<float>::quiet_NaN(),
                                std::numeric_limits<float>::infinity(),
                                -std::numeric_limits<float>::infinity(), -1.0f};
    for (lab::Image* image : {&g.frame.depth, &g.frame.normal, &g.frame.radiance})
        for (float& value : image->data)
            if (random.chance(0.01)) value = values[random.integer(0, 3)];
}

void oneHotPixel(GBuffer& g, Random&) {
    std::fill(g.frame.radiance.data.begin(), g.frame.radiance.data.end(), 0.0f);
    const Extent2D e = g.settings.resolution;
    std::fill_n(g.frame.radiance.at(e.width / 2, e.height / 2), 3, runner::largestHalf);
}

void everyPixelAtTheEnd(GBuffer& g, Random&) {
    std::fill(g.frame.radiance.data.begin(), g.frame.radiance.data.end(), runner::largestHalf);
}

void byPoints(GBuffer& g, Random&) { g.settings.formFactor = FormFactor::pointToPoint; }

void makeBlack(GBuffer& g, Random&) {
    std::fill(g.frame.radiance.data.begin(), g.frame.radiance.data.end(), 0.0f);
}

void scaleLengths(lab::Frame& frame, float size) {
    for (float& z : frame.depth.data) z *= size;
    frame.camera.position *= size;
    frame.camera.target *= size;
    frame.camera.orthographicHeight *= size;
    frame.camera.nearPlane *= size;
    frame.camera.farPlane *= size;
}

// size: the scene's lengths are multiplied by it.
Result<Case> sceneCase(const std::string& name, const techniques::Technique& technique,
                       const techniques::Draft& draft, Extent2D extent, float size = 1.0f) {
    auto scene = lab::loadScene(name);
    if (!scene) return scene.error();
    auto view = lab::findCamera(*scene, "");
    if (!view) return view.error();
    lab::FrameOptions options;
    options.extent = extent;
    options.lightSamples = 4; // noise is as good a test as its absence
    auto frame = lab::renderFrame(*scene, *view, options);
    if (!frame) return frame.error();
    auto configured = technique.parse(draft, techniques::viewOf(*frame), techniques::Spelling::options);
    if (!configured) return configured.error();
    auto whole = techniques::completed(*std::move(configured),
                                       {std::make_shared<const lab::Scene>(*std::move(scene)), 0, {}}, name);
    if (!whole) return whole.error();
    const lab::Image outgoing = lab::outgoingRadiance(*frame);
    scaleLengths(*frame, size);
    auto inputs = whole->inputs(*frame, outgoing, outgoing);
    if (!inputs) return inputs.error();
    float largestRadiance = 0;
    for (const float value : outgoing.data) largestRadiance = std::max(largestRadiance, value);
    auto tolerances = techniqueTolerances(whole->plan, largestRadiance);
    return Case{std::move(whole->plan), *std::move(inputs), Precision::half, std::move(tolerances)};
}

std::string toText(const techniques::Draft& draft) {
    std::string text;
    for (const auto& [option, value] : draft)
        text += " " + (option == "preset" ? value : option + " " + value);
    return text;
}

} // namespace

std::vector<NamedCase> randomCases(int count, uint64_t seed) {
    std::vector<NamedCase> cases;
    Random seeds(seed);
    for (int i = 0; i < count; ++i) {
        const uint64_t own = seeds.bits();
        cases.push_back({"random " + std::to_string(i), [own] { return randomCase(own); }});
    }
    return cases;
}

std::vector<NamedCase> hardCases() {
    GBufferOptions plain, sky, grazing, tiny, huge, nearAndFar, corner;
    nearAndFar.scale = 0.1;
    nearAndFar.farRatio = 1e5;
    nearAndFar.patches = 24;
    corner.corner = true;
    sky.skyShare = 1.1;
    grazing.grazing = true;
    tiny.scale = 1e-4;
    huge.scale = 1e5;
    const Extent2D usual{97, 61};
    return {hardCase("1x1", {1, 1}, plain),
            hardCase("odd sizes", {31, 17}, plain),
            hardCase("7x4096", {7, 4096}, plain),
            hardCase("4096x3", {4096, 3}, plain),
            hardCase("all sky", usual, sky),
            hardCase("grazing planes", usual, grazing),
            hardCase("1e-4 m", usual, tiny),
            hardCase("1e5 m", usual, huge),
            hardCase("not numbers", usual, plain, sprinkleNonNumbers),
            hardCase("black", usual, plain, makeBlack),
            hardCase("one hot pixel", usual, plain, oneHotPixel),
            hardCase("every pixel at 65504", usual, plain, everyPixelAtTheEnd),
            hardCase("near over far of 1e5", usual, nearAndFar),
            hardCase("point factor in a corner", usual, corner, byPoints)};
}

std::vector<NamedCase> sceneCases(const SceneCases& options, const techniques::Technique& technique) {
    std::vector<NamedCase> cases;
    const Extent2D extent = options.extent;
    for (const std::string& scene : options.scenes)
        for (const techniques::Draft& draft : technique.examples)
            cases.push_back({scene + toText(draft), [scene, &technique, draft, extent] {
                                 return sceneCase(scene, technique, draft, extent);
                             }});
    // The room is 5.5 m wide.
    for (const auto& [name, size] : {std::pair{"0.1 m", 0.1f / 5.5f}, std::pair{"10 km", 1e4f / 5.5f}})
        cases.push_back({std::string("builtin:cornell, ") + name, [size = size, &technique, extent] {
                             return sceneCase("builtin:cornell", technique, technique.examples[0], extent,
                                              size);
                         }});
    return cases;
}

} // namespace rebound::conformance
