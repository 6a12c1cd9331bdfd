// SPDX-License-Identifier: MIT
// Glossy light of precomputed illuminance composition: lobes against closed forms, and bakes without a pattern against a
// plain loop.
#include "composition_frame.hpp"
#include "composition_model.hpp"
#include "random_bake.hpp"

#include <cmath>
#include <limits>

namespace rebound::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();

IlluminanceCompositionSettings glossySettings(const Bake& bake, GlossyLobe lobe,
                                              std::optional<float> exponent, Extent2D extent = {19, 7}) {
    auto settings = settingsFor(bake, extent);
    settings.glossy = lobe;
    settings.glossyExponent = exponent;
    return settings;
}

void scatterPixels(CompositionFrames& frames, uint32_t seed) {
    Numbers32 random(seed);
    for (int y = 0; y < frames.settings.resolution.height; ++y)
        for (int x = 0; x < frames.settings.resolution.width; ++x) {
            frames.depth.at(x, y, 0) = random.within(0.05f, 9.0f);
            const glm::vec3 n = random.direction();
            for (int c = 0; c < 3; ++c) frames.normal.at(x, y, c) = n[c];
        }
}

// Of the orthographic camera of CompositionFrames, which looks down -z.
glm::vec3 axisOf(glm::vec3 normal) { return glm::reflect(glm::vec3(0, 0, -1), normal); }

float sharpness(GlossyLobe lobe, float exponent) {
    return lobe == GlossyLobe::mirror ? exponent : 0.25f * exponent;
}

// Every cache sees radiance 1 + d . up.
Bake cosineSky(uint32_t bands, glm::vec3 up) {
    MadeBake made = gridInView();
    made.bands = bands;
    const int steps = bands == 2 ? 511 : 127;
    for (MadeCache& cache : made.caches) {
        MadeLink link{0, factorOfSphere(), {}, {}};
        link.shape[3] = int(std::lround(float(steps) * up.x / 3.0f)); // x is coefficient 3
        cache.links.push_back(link);
    }
    return made.pack();
}

} // namespace

TEST_CASE("glossy composition: a constant sphere's radiance, through any lobe") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) linkAround(cache, 1.0f);
    const Bake bake = made.pack();
    for (GlossyLobe lobe : {GlossyLobe::mirror, GlossyLobe::halfVector})
        for (float exponent : {0.0f, 1.0f, 20.0f, 64.0f})
            for (cpu::Isa isa : cpu::availableIsas()) {
                CompositionFrames frames(isa, bake, glossySettings(bake, lobe, exponent));
                scatterPixels(frames, 3);
                frames.run();
                // Six links leave bands 1 and 2 without anything but rounding.
                for (float value : frames.glossy.values) CHECK(std::abs(value - 1.0f) <= 2e-5f);
            }
}

TEST_CASE("glossy composition: a cosine sky through lobes is 1 + (n + 1) / (n + 2) d . up") {
    const glm::vec3 up(1, 0, 0);
    for (uint32_t bands : {2u, 3u, 4u}) {
        const Bake bake = cosineSky(bands, up);
        for (GlossyLobe lobe : {GlossyLobe::mirror, GlossyLobe::halfVector})
            for (float exponent : {1.0f, 5.0f, 20.0f})
                for (bool isOfPixel : {false, true})
                    for (cpu::Isa isa : cpu::availableIsas()) {
                        const auto settings = glossySettings(
                            bake, lobe, isOfPixel ? std::nullopt : std::optional<float>(exponent));
                        CompositionFrames frames(isa, bake, settings);
                        scatterPixels(frames, 7);
                        std::fill(frames.exponent.values.begin(), frames.exponent.values.end(), exponent);
                        frames.run();
                        for (int y = 0; y < 7; ++y)
                            for (int x = 0; x < 19; ++x) {
                                const float sharp = sharpness(lobe, exponent);
                                const float along = glm::dot(up, axisOf(frames.normalAt(x, y)));
                                const float right = 1.0f + (sharp + 1.0f) / (sharp + 2.0f) * along;
                                // Half a step of the stored number, times up to 3.
                                const float step = 1.5f / (bands == 2 ? 511.0f : 127.0f);
                                CHECK(std::abs(frames.glossy.at(x, y, 0) - right) <= step + 2e-5f);
                            }
                    }
    }
}

TEST_CASE(
    "glossy composition: bakes without a pattern are what a plain loop gives, by each pixel's exponent") {
    uint32_t seed = 300;
    for (uint32_t bands : {2u, 3u, 4u})
        for (GlossyLobe lobe : {GlossyLobe::mirror, GlossyLobe::halfVector}) {
            const Bake bake = randomBake(++seed, bands, LinkForm::coefficients, 40, 2).pack();
            CompositionModel model(bake, false, true);
            const std::vector<float> light(3 * size_t(BakeLayout::stride(40)), 1.0f);
            model.run(light);
            for (cpu::Isa isa : cpu::availableIsas()) {
                auto settings = glossySettings(bake, lobe, std::nullopt, {37, 11});
                settings.emission = true;
                settings.writeIndirect = false; // glossy light alone is an output too
                CompositionFrames frames(isa, bake, settings);
                scatterPixels(frames, seed);
                Numbers32 random(seed + 1);
                for (float& e : frames.exponent.values) e = random.within(0.0f, 30.0f);
                frames.light = light;
                frames.run();
                double sum = 0.0, worst = 0.0, largest = 0.0;
                for (int y = 0; y < 11; ++y)
                    for (int x = 0; x < 37; ++x) {
                        const glm::vec3 n = frames.normalAt(x, y);
                        const glm::dvec3 right =
                            model.through(frames.position(x, y), n, axisOf(n),
                                          double(sharpness(lobe, frames.exponent.at(x, y, 0))));
                        for (int c = 0; c < 3; ++c) {
                            const double off = std::abs(right[c] - double(frames.glossy.at(x, y, c)));
                            sum += off / (37 * 11 * 3);
                            worst = std::max(worst, off);
                            largest = std::max(largest, right[c]);
                        }
                    }
                CHECK(largest > 0.1);
                // As for diffuse light; normals are doubled into a mirror's direction.
                CHECK(sum < 1e-5 * largest);
                CHECK(worst < 2e-3 * largest);
            }
        }
}

TEST_CASE("glossy composition: exponents that are none, and pixels without a surface, do no harm") {
    const Bake bake = cosineSky(3, {1, 0, 0});
    for (cpu::Isa isa : cpu::availableIsas()) {
        CompositionFrames frames(isa, bake, glossySettings(bake, GlossyLobe::mirror, std::nullopt));
        const float wrong[] = {nan, infinity, -infinity, -3.0f, 1e30f};
        const float stands[] = {0.0f, 0.0f, 0.0f, 0.0f, 64.0f};
        frames.setNormals(glm::normalize(glm::vec3(1, 0, 2)));
        for (int i = 0; i < 5; ++i) frames.exponent.at(i, 0, 0) = wrong[i];
        for (int i = 0; i < 5; ++i) frames.exponent.at(i, 1, 0) = stands[i];
        frames.depth.at(7, 0, 0) = nan;
        frames.run();
        for (int i = 0; i < 5; ++i)
            CHECK(frames.glossy.at(i, 0, 0) == doctest::Approx(frames.glossy.at(i, 1, 0)).epsilon(1e-5));
        CHECK(frames.glossy.at(7, 0, 0) == 0.0f);
    }
}

TEST_CASE("glossy composition: nothing of it is in a plan without") {
    const Bake bake = gridInView().pack();
    const Plan without = *planIlluminanceComposition(settingsFor(bake));
    CHECK(without.find("glossy") < 0);
    CHECK(without.find("exponent") < 0);
    const Plan constant = *planIlluminanceComposition(glossySettings(bake, GlossyLobe::mirror, 5.0f));
    CHECK(constant.passes.size() == without.passes.size() + 1);
    CHECK(constant.find("exponent") < 0);
    auto settings = glossySettings(bake, GlossyLobe::mirror, std::nullopt);
    settings.writeIndirect = false;
    const Plan alone = *planIlluminanceComposition(settings);
    CHECK(alone.passes.size() == without.passes.size());
    CHECK(alone.find("exponent") >= 0);
    CHECK(alone.find("indirect") < 0);
}

} // namespace rebound::test
