// SPDX-License-Identifier: MIT
// Which settings, buffers and cameras precomputed illuminance composition takes, and what its plan holds.
#include "composition_frame.hpp"
#include "random_bake.hpp"

namespace rebound::test {
namespace {

std::string refusal(const IlluminanceCompositionSettings& settings) {
    const auto plan = planIlluminanceComposition(settings);
    REQUIRE_FALSE(plan);
    return plan.error().message;
}

template <class Change>
std::string refusalWith(Change change) {
    auto settings = settingsFor(gridInView().pack());
    change(settings);
    return refusal(settings);
}

Plan planOf(const IlluminanceCompositionSettings& settings) {
    auto plan = planIlluminanceComposition(settings);
    REQUIRE_MESSAGE(plan, (plan ? "" : plan.error().message));
    const auto valid = validate(*plan);
    REQUIRE_MESSAGE(valid, (valid ? "" : valid.error().message));
    return *plan;
}

const Resource* resourceNamed(const Plan& plan, std::string_view name) {
    const ResourceIndex index = plan.find(name);
    return index < 0 ? nullptr : &plan.resources[size_t(index)];
}

} // namespace

TEST_CASE("composition: settings out of range are refused by name") {
    CHECK(refusalWith([](auto& s) {
              s.resolution = {0, 720};
          }) == "settings.resolution is 0x720; 1x1 to 16384x16384 was expected");
    CHECK(refusalWith([](auto& s) {
              s.resolution = {16385, 1};
          }) == "settings.resolution is 16385x1; 1x1 to 16384x16384 was expected");
    CHECK(refusalWith([](auto& s) { s.writeIndirect = false; }) ==
          "settings.writeIndirect and settings.compose are both false, and settings.glossy is none; one "
          "output was "
          "expected");
    for (float exponent : {-1.0f, 65.0f, std::numeric_limits<float>::quiet_NaN()})
        CHECK(refusalWith([&](auto& s) {
                  s.glossy = GlossyLobe::mirror;
                  s.glossyExponent = exponent;
              }).find("0 to 64 was expected") != std::string::npos);
    CHECK(refusalWith([](auto& s) { s.lightMap = true; }) ==
          "settings.lightMap is true, but settings.bake has no light map; one that has was expected");
    CHECK(refusalWith([](auto& s) { s.bake = {}; }) ==
          "settings.bake: the bake's number of surfels is 0; 1 to 1048576 was expected");
    CHECK(refusalWith([](auto& s) { s.bake.bands = 5; }) ==
          "settings.bake: the bake's number of bands is 5; 2 to 4 was expected");
    CHECK(refusalWith([](auto& s) { s.bake.links = 0; }) ==
          "settings.bake: the bake's number of links a cache is 0; 1 to 4096 was expected");
    CHECK(refusalWith([](auto& s) { s.bake.spacing = 0.0f; }) ==
          "settings.bake: the bake's spacing is 0.000000; a positive number was expected");
    CHECK(refusalWith([](auto& s) {
              s.bake.caches = 1u << 20;
              s.bake.links = 4096;
          }) == "settings.bake has 17179869184 bytes of linkNodes; at most 4294967296 were expected");
}

TEST_CASE("composition: a plan has a pass a step, and nothing of what is switched off") {
    MadeBake made = gridInView();
    made.surfels.assign(5, made.surfels[0]);
    auto settings = settingsFor(made.pack());
    const Plan plain = planOf(settings);
    std::string labels;
    for (const Pass& pass : plain.passes) labels += pass.label + ", ";
    CHECK(labels == "light surfels, pull stage 0, pull stage 1, pull stage 2, light caches, shade, ");
    CHECK(resourceNamed(plain, "albedo") == nullptr);
    CHECK(resourceNamed(plain, "lit") == nullptr);
    CHECK(resourceNamed(plain, "composed") == nullptr);
    CHECK(resourceNamed(plain, "caches")->kind == ResourceKind::transientBuffer);
    CHECK(memoryUse(plain)->persistent == 0);
    settings.bounces = settings.compose = true;
    settings.writeIndirect = false;
    const Plan other = planOf(settings);
    CHECK(other.passes.back().label == "shade and compose");
    CHECK(resourceNamed(other, "indirect") == nullptr);
    // 9 coefficients of three colours, and one float to a multiple of four.
    CHECK(memoryUse(other)->persistent == settings.bake.caches * 28 * sizeof(float));
}

TEST_CASE("composition: without the light map, a bake that has one costs nothing for it") {
    const Bake bake = randomBake(3, 3, LinkForm::coefficients, 20, 2, 40).pack();
    auto settings = settingsFor(bake);
    settings.bounces = true;
    const Plan grid = planOf(settings);
    CHECK(resourceNamed(grid, "map place") == nullptr);
    CHECK(resourceNamed(grid, "mapTexels") == nullptr);
    CHECK(resourceNamed(grid, "mapCorners") == nullptr);
    CHECK(memoryUse(grid)->persistent == bake.layout.gridCaches() * 28 * sizeof(float));
    settings.lightMap = true;
    const Plan map = planOf(settings);
    CHECK(resourceNamed(map, "map place")->channels == 2);
    CHECK(resourceNamed(map, "mapTexels")->kind == ResourceKind::inputBuffer);
    CHECK(resourceNamed(map, "mapCorners") == nullptr);
    CHECK(memoryUse(map)->persistent == bake.layout.caches * 28 * sizeof(float));
    CHECK(map.passes.size() == grid.passes.size());
}

TEST_CASE("composition: one surfel needs no stage, and no buffer of terms") {
    const Bake bake = gridInView().pack();
    const Plan plan = planOf(settingsFor(bake));
    CHECK(plan.passes.size() == 3);
    CHECK(resourceNamed(plan, "terms")->kind == ResourceKind::buffer);
    CHECK(resourceNamed(plan, "receivers")->kind == ResourceKind::buffer);
    CHECK(resourceNamed(plan, "cells")->kind == ResourceKind::inputBuffer);
}

TEST_CASE(
    "composition: buffers that are too small, and a camera that contradicts the conventions, are refused") {
    const Bake bake = randomBake(1, 3, LinkForm::coefficients, 70, 2).pack();
    CompositionFrames frames(cpu::Isa::automatic, bake, settingsFor(bake));
    const auto refused = [&] {
        const auto recorded = frames.program->record(frames.inputs());
        REQUIRE_FALSE(recorded);
        return recorded.error().message;
    };
    frames.light.resize(210);
    CHECK(refused() == "inputs.buffers: surfel light has 840 bytes; 1536 or more were expected");
    frames.light.resize(384);
    frames.bake.sections[size_t(BakeSection::cells)] =
        frames.bake.sections[size_t(BakeSection::cells)].first(100);
    CHECK(refused() == "inputs.buffers: cells has 400 bytes; " +
                           std::to_string(4 * sizeOf(bake.layout, BakeSection::cells)) +
                           " or more were expected");
    IlluminanceCompositionFrame<cpu::Image> frame;
    frame.camera.projection = glm::perspective(1.0f, 1.0f, 0.1f, 10.0f);
    const auto inputs = illuminanceCompositionInputs(frames.settings, frame);
    REQUIRE_FALSE(inputs);
    CHECK(inputs.error().message ==
          "camera.projection is perspective, but conventions.projection says orthographic");
}

TEST_CASE("composition: only passes that say so read a buffer that they write, and no image") {
    MadeBake made = gridInView();
    made.surfels.assign(2, made.surfels[0]);
    Plan plan = planOf(settingsFor(made.pack()));
    plan.passes[1].readsElsewhere = false;
    const auto valid = validate(plan);
    REQUIRE_FALSE(valid);
    CHECK(valid.error().message == "plan.passes: pull stage 0 reads and writes nodes");
    Plan images{"images", {}, {}};
    const auto image = images.add({"image", ResourceKind::transient, Format::rgba16f, 4, {4, 4}, {}, 0});
    images.passes = {{"first", "copy", {}, {{0, image, Access::write}}, {4, 4}},
                     {"second", "copy", {}, {{0, image}, {1, image, Access::write}}, {4, 4}}};
    images.passes[1].readsElsewhere = true;
    const auto refused = validate(images);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "plan.passes: second reads and writes image");
}

} // namespace rebound::test
