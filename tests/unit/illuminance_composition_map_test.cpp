// SPDX-License-Identifier: MIT
// Pixels lit by a bake's light map, against closed forms and a plain loop.
#include "composition_frame.hpp"
#include "composition_model.hpp"
#include "random_bake.hpp"

#include <cmath>
#include <limits>

namespace rebound::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();

// The grid gives 5, a map of 4 x 3 texels 1, 2, 3 and 4 from left to right, and nothing in its last row.
MadeBake stripes() {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) linkAround(cache, 5.0f);
    const uint32_t first = uint32_t(made.caches.size());
    made.surfaceCaches = 4;
    made.mapSize = {4, 3};
    for (uint32_t i = 0; i < 4; ++i) {
        made.caches.emplace_back();
        linkAround(made.caches.back(), float(i + 1));
    }
    for (uint32_t i = 0; i < 12; ++i)
        made.mapTexels.push_back(i < 8 ? first + i % 4 : BakeLayout::noMapTexel);
    return made;
}

IlluminanceCompositionSettings mapSettings(const Bake& bake, Extent2D extent = {19, 7}) {
    auto settings = settingsFor(bake, extent);
    settings.lightMap = true;
    return settings;
}

} // namespace

TEST_CASE("composition: the light map is linear between texels, and pixels outside of it have the grid") {
    const Bake bake = stripes().pack();
    struct Expected {
        float x, y, light;
    };
    const Expected expected[] = {{0.5f, 0.5f, 1},    {1.5f, 1.0f, 2},  {2.25f, 0.75f, 2.75f}, {3.5f, 0.5f, 4},
                                 {2.5f, 2.0f, 1.5f}, {2.5f, 2.5f, 0},  {0.4f, 0.5f, 5},       {3.6f, 0.5f, 5},
                                 {1.0f, 2.6f, 5},    {-1, -1, 5},      {nan, 1, 5},           {1, nan, 5},
                                 {infinity, 1, 5},   {1, -infinity, 5}};
    for (cpu::Isa isa : cpu::availableIsas()) {
        CompositionFrames frames(isa, bake, mapSettings(bake));
        for (int x = 0; x < 14; ++x) {
            frames.mapPlace.at(x, 3, 0) = expected[x].x;
            frames.mapPlace.at(x, 3, 1) = expected[x].y;
        }
        frames.mapPlace.at(15, 3, 0) = frames.mapPlace.at(15, 3, 1) = 1.0f;
        frames.depth.at(15, 3, 0) = 0.0f; // no surface
        frames.run();
        for (int x = 0; x < 14; ++x)
            CHECK(frames.indirectAt(x, 3).y == doctest::Approx(expected[x].light).epsilon(1e-5));
        CHECK(frames.indirectAt(15, 3).y == 0.0f);
    }
}

TEST_CASE("composition: bakes with a light map, over frames, are what a plain loop gives") {
    uint32_t seed = 300;
    for (uint32_t bands : {2u, 3u, 4u})
        for (LinkForm form : {LinkForm::coefficients, LinkForm::direction}) {
            const Bake bake = randomBake(++seed, bands, form, 60, 2, 29).pack();
            CompositionModel model(bake, true, true);
            std::vector<float> light(3 * size_t(BakeLayout::stride(60)));
            Numbers32 random(seed);
            for (float& l : light) l = random.within(0.0f, 4.0f);
            for (int frame = 0; frame < 3; ++frame) model.run(light);
            for (cpu::Isa isa : cpu::availableIsas()) {
                auto settings = mapSettings(bake, {37, 11});
                settings.bounces = settings.emission = settings.compose = true;
                CompositionFrames frames(isa, bake, settings);
                for (float& place : frames.mapPlace.values) place = random.within(-1.0f, 8.0f);
                for (int y = 0; y < 11; ++y)
                    for (int x = 0; x < 37; ++x) {
                        frames.depth.at(x, y, 0) = random.within(0.05f, 9.0f);
                        const glm::vec3 n = random.direction();
                        for (int c = 0; c < 3; ++c) frames.normal.at(x, y, c) = n[c];
                    }
                frames.light = light;
                for (int frame = 0; frame < 3; ++frame) frames.run();
                double worst = 0.0, largest = 0.0;
                for (int y = 0; y < 11; ++y)
                    for (int x = 0; x < 37; ++x) {
                        const glm::dvec2 place(frames.mapPlace.at(x, y, 0), frames.mapPlace.at(x, y, 1));
                        const glm::dvec3 right =
                            model.at(place, frames.position(x, y), frames.normalAt(x, y));
                        for (int c = 0; c < 3; ++c) {
                            worst = std::max(worst, std::abs(right[c] - double(frames.indirect.at(x, y, c))));
                            largest = std::max(largest, right[c]);
                        }
                    }
                CHECK(largest > 0.1);
                CHECK(worst <
                      1e-3 * largest); // as of the grid, which lights a part of the pixels and all surfels
            }
        }
}

} // namespace rebound::test
