// SPDX-License-Identifier: MIT
// Light from surfels to the picture, frame by frame: against closed forms, and bakes without a pattern against a plain
// loop.
#include "composition_checks.hpp"
#include "composition_model.hpp"
#include "test_camera.hpp"

#include <cmath>
#include <limits>

namespace rebound::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

} // namespace

TEST_CASE("composition: nodes are sums of surfels, for one, two and many, whatever the tree") {
    for (uint32_t count : {1u, 2u, 3u, 37u, 1000u})
        for (uint32_t terms : {2u, 3u, 8u}) {
            MadeBake made = gridInView();
            made.terms = terms;
            made.surfels.assign(count, made.surfels[0]);
            for (uint32_t i = 0; i < count; ++i) made.surfels[i].area = 0.25f * float(1 + i % 3);
            MadeBake probe = made;
            const uint32_t root = probe.pack().layout.nodes - 1;
            for (MadeCache& cache : made.caches) linkAround(cache, 1.0f, root);
            const Bake bake = made.pack();
            float total = 0.0f; // exact: quarters
            for (uint32_t i = 0; i < count; ++i) total += made.surfels[i].area * float(1 + i % 7);
            for (cpu::Isa isa : cpu::availableIsas()) {
                CompositionFrames frames(isa, bake, settingsFor(bake));
                for (uint32_t i = 0; i < count; ++i)
                    for (uint32_t c = 0; c < 3; ++c)
                        frames.light[c * BakeLayout::stride(count) + i] = float(1 + i % 7) * float(c + 1);
                frames.run();
                checkEverywhere(frames, total * glm::vec3(1, 2, 3), 3.0 * double(total) * single);
            }
        }
}

TEST_CASE("composition: each frame adds a bounce, and reset begins anew") {
    MadeBake made = gridInView();
    made.surfels[0] = {{4, 4, -4}, {0, 0, 1}, 1.0f, glm::vec3(511.5f / 1023.0f), glm::vec3(1.0f, 2.0f, 0.5f)};
    const double albedo = 512.0 / 1023.0; // as it is packed
    for (MadeCache& cache : made.caches) linkAround(cache, 1.0f);
    const Bake bake = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        auto settings = settingsFor(bake);
        settings.emission = true;
        CompositionFrames once(isa, bake, settings);
        settings.bounces = true;
        CompositionFrames frames(isa, bake, settings);
        std::fill(frames.light.begin(), frames.light.end(), 0.0f);
        std::fill(once.light.begin(), once.light.end(), 0.0f);
        for (int start = 0; start < 2; ++start) {
            double sum = 0.0, power = 1.0;
            for (int frame = 0; frame < 6; ++frame) {
                sum += power;
                power *= albedo;
                frames.run();
                checkEverywhere(frames, float(sum) * glm::vec3(1.0f, 2.0f, 0.5f), 6.0 * single);
                once.run();
                checkEverywhere(once, glm::vec3(1.0f, 2.0f, 0.5f), 2.0 * single);
            }
            frames.program->reset();
        }
    }
}

TEST_CASE("composition: emission that is switched off, or light that is doubled") {
    MadeBake made = randomBake(3, 3, LinkForm::coefficients, 100, 2);
    for (MadeSurfel& s : made.surfels) s.emission = glm::vec3(0.0f);
    const Bake dark = made.pack();
    for (MadeSurfel& s : made.surfels) s.emission = glm::vec3(3.0f);
    const Bake bright = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        auto settings = settingsFor(dark);
        settings.bounces = true;
        CompositionFrames without(isa, bright, settings), doubled(isa, dark, settings);
        settings.emission = true;
        CompositionFrames with(isa, dark, settings);
        for (CompositionFrames* frames : {&without, &doubled, &with}) scatterPixels(*frames, 1);
        for (float& l : doubled.light) l *= 2.0f;
        for (int frame = 0; frame < 3; ++frame) {
            for (CompositionFrames* frames : {&without, &doubled, &with}) frames->run();
            CHECK(sameBits(without.indirect, with.indirect));
            // Twice the light is twice the result to the last bit.
            for (float& value : with.indirect.values) value *= 2.0f;
            CHECK(sameBits(doubled.indirect, with.indirect));
        }
    }
}

TEST_CASE("composition: light that is no number, negative or beyond measure does no lasting harm") {
    const Bake bake = randomBake(11, 3, LinkForm::coefficients, 37, 3).pack();
    const size_t stride = BakeLayout::stride(37);
    for (cpu::Isa isa : cpu::availableIsas()) {
        auto settings = settingsFor(bake);
        settings.bounces = true;
        CompositionFrames harmed(isa, bake, settings), sound(isa, bake, settings);
        scatterPixels(harmed, 2);
        scatterPixels(sound, 2);
        const auto set = [&](CompositionFrames& f, size_t surfel, float r, float g, float b) {
            f.light[surfel] = r;
            f.light[stride + surfel] = g;
            f.light[2 * stride + surfel] = b;
        };
        set(harmed, 0, nan, 1, 1);
        set(harmed, 1, 1, infinity, 1);
        set(harmed, 2, 1, 1, -infinity);
        set(harmed, 3, -1, -2, 3);
        set(harmed, 36, 3e38f, 1, 1);
        for (size_t i = 0; i < 3; ++i) set(sound, i, 0, 0, 0);
        set(sound, 3, 0, 0, 3);
        set(sound, 36, 65504, 1, 1);
        for (int frame = 0; frame < 4; ++frame) {
            harmed.run();
            sound.run();
            CHECK(sameBits(harmed.indirect, sound.indirect));
            for (float value : harmed.indirect.values) CHECK(std::isfinite(value));
            std::fill(harmed.light.begin(), harmed.light.end(), 1.0f);
            std::fill(sound.light.begin(), sound.light.end(), 1.0f);
        }
    }
}

TEST_CASE("composition: pixels without a surface receive nothing, and their composed is lit") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) linkAround(cache, 1.0f);
    const Bake bake = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        auto settings = settingsFor(bake);
        settings.compose = true;
        CompositionFrames frames(isa, bake, settings);
        frames.depth.at(0, 0, 0) = 0.0f;
        frames.depth.at(1, 0, 0) = nan;
        frames.depth.at(2, 0, 0) = infinity;
        frames.depth.at(3, 0, 0) = -4.0f;
        frames.normal.at(4, 0, 1) = nan;
        frames.normal.at(5, 0, 2) = 0.0f;
        frames.normal.at(6, 0, 0) = infinity;
        frames.depth.at(18, 6, 0) = 2e7f;
        frames.run();
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 19; ++x) {
                const bool isEmpty = (y == 0 && x <= 6) || (y == 6 && x == 18);
                for (int c = 0; c < 3; ++c) {
                    CHECK(std::abs(frames.indirect.at(x, y, c) - (isEmpty ? 0.0f : 1.0f)) <= single);
                    CHECK(std::abs(frames.composed.at(x, y, c) - (isEmpty ? 0.25f : 0.75f)) <= single);
                }
            }
    }
}

TEST_CASE("composition: each choice of outputs gives the same light") {
    const Bake bake = randomBake(5, 4, LinkForm::direction, 20, 2).pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        auto settings = settingsFor(bake);
        CompositionFrames indirect(isa, bake, settings);
        settings.compose = true;
        CompositionFrames both(isa, bake, settings);
        settings.writeIndirect = false;
        CompositionFrames composed(isa, bake, settings);
        for (CompositionFrames* frames : {&indirect, &both, &composed}) {
            scatterPixels(*frames, 4);
            frames->run();
        }
        // Three kernels, in which compilers may contract other products and sums.
        for (size_t i = 0; i < both.composed.values.size(); ++i) {
            CHECK(std::abs(indirect.indirect.values[i] - both.indirect.values[i]) <= single);
            CHECK(std::abs(composed.composed.values[i] - both.composed.values[i]) <= single);
        }
        for (size_t i = 0; i < both.composed.values.size(); ++i)
            CHECK(both.composed.values[i] ==
                  doctest::Approx(0.25f + 0.5f * both.indirect.values[i]).epsilon(1e-6));
    }
}

TEST_CASE("composition: bakes without a pattern, over frames, are what a plain loop gives") {
    uint32_t seed = 100;
    for (uint32_t bands : {2u, 3u, 4u})
        for (LinkForm form : {LinkForm::coefficients, LinkForm::direction}) {
            const uint32_t count = 30 + 50 * bands;
            const Bake bake = randomBake(++seed, bands, form, count, bands).pack();
            CompositionModel model(bake, true, true);
            std::vector<std::vector<glm::dvec3>> expected;
            std::vector<float> light(3 * size_t(BakeLayout::stride(count)));
            Numbers32 random(seed);
            for (float& l : light) l = random.within(0.0f, 4.0f);
            for (int frame = 0; frame < 3; ++frame) model.run(light);
            for (cpu::Isa isa : cpu::availableIsas()) {
                auto settings = settingsFor(bake, {37, 11});
                settings.bounces = settings.emission = true;
                CompositionFrames frames(isa, bake, settings);
                scatterPixels(frames, seed);
                frames.light = light;
                for (int frame = 0; frame < 3; ++frame) frames.run();
                double worst = 0.0, sum = 0.0, largest = 0.0;
                for (int y = 0; y < 11; ++y)
                    for (int x = 0; x < 37; ++x) {
                        const glm::dvec3 right = model.at(frames.position(x, y), frames.normalAt(x, y));
                        for (int c = 0; c < 3; ++c) {
                            const double off = std::abs(right[c] - double(frames.indirect.at(x, y, c)));
                            worst = std::max(worst, off);
                            sum += off / (37 * 11 * 3);
                            largest = std::max(largest, right[c]);
                        }
                    }
                CHECK(largest > 0.1);
                // Positions are rounded to 1e-6 cells, and ramps are as steep as 6 a cell.
                CHECK(sum < 5e-6 * largest);
                // Where all caches lie just in front of a receiver's plane, their weights are what that rounding leaves.
                CHECK(worst < 1e-3 * largest);
            }
        }
}

TEST_CASE("composition: positions and normals reach the world from every convention") {
    MadeBake made = wholeGrid(glm::uvec3(2), glm::vec3(-4.0f, -3.0f, 1.0f));
    made.surfels[0].albedo = glm::vec3(1.0f);
    for (MadeCache& cache : made.caches) {
        linkAround(cache, 10.0f + glm::dot(cache.place, glm::vec3(0.7f, -0.4f, 0.3f)));
        cache.links[0].factor *= 2.0f; // not the same from everywhere
    }
    made.linkForm = LinkForm::direction;
    const Bake bake = made.pack();
    CompositionModel model(bake, false, false);
    model.run(std::vector<float>(3 * 64, 1.0f));
    const glm::mat4 someView =
        glm::lookAt(glm::vec3(3, 1, -2), glm::vec3(-1, 0.5f, 4), glm::vec3(0.2f, 1, 0.1f));
    const Lens lens;
    for (const GBufferConventions& c : everyConvention()) {
        auto settings = settingsFor(bake, {13, 5});
        settings.conventions = c;
        const glm::mat4 view = viewOf(c, someView), projection = projectionOf(c, lens);
        CompositionFrames frames(deviceFor(cpu::Isa::automatic).isa(), bake, settings);
        frames.camera = {view, projection};
        Numbers32 random(8);
        std::vector<glm::dvec3> positions, normals;
        const double forward = c.handedness == Handedness::right ? -1.0 : 1.0;
        const glm::dmat4 toClip = glm::dmat4(projection);
        for (int i = 0; i < 13 * 5; ++i) {
            const double distance = 0.7 + 0.1 * i;
            const double ndcX = (i % 13 + 0.5) / 13.0 * 2.0 - 1.0, rows = (i / 13 + 0.5) / 5.0 * 2.0 - 1.0;
            const double ndcY = c.firstRow == FirstRow::top ? -rows : rows;
            // The point at that distance: clip = P (x, y, forward d, 1), linear in x and in y.
            const double z = forward * distance, w = toClip[2][3] * z + toClip[3][3];
            const double vx = (ndcX * w - toClip[2][0] * z - toClip[3][0]) / toClip[0][0];
            const double vy = (ndcY * w - toClip[2][1] * z - toClip[3][1]) / toClip[1][1];
            positions.push_back(glm::dvec3(glm::inverse(glm::dmat4(view)) * glm::dvec4(vx, vy, z, 1.0)));
            normals.push_back(random.direction());
            frames.depth.values[size_t(i)] = storedDepth(c, lens, distance);
            const glm::vec3 stored = storedNormal(c, view, glm::vec3(normals.back()));
            for (int k = 0; k < 3; ++k) frames.normal.values[size_t(3 * i + k)] = stored[k];
        }
        frames.run();
        for (size_t i = 0; i < positions.size(); ++i)
            // Stored depth is known to 1e-4 of the distance, of up to 7 m: see camera_math_test.cpp. Caches differ by 0.8
            // a metre, and ramps are as steep as 6 a metre of differences of a few percent.
            CHECK(frames.indirect.values[3 * i] ==
                  doctest::Approx(model.at(positions[i], normals[i]).x).epsilon(1e-3));
    }
}

TEST_CASE("composition: the same bits for any number of threads") {
    const Bake bake = randomBake(21, 3, LinkForm::coefficients, 900, 2).pack();
    auto settings = settingsFor(bake, {64, 130});
    settings.bounces = settings.emission = true;
    std::optional<CompositionFrames> one;
    one.emplace(cpu::Isa::automatic, bake, settings, 1);
    scatterPixels(*one, 6);
    for (int threads : {2, 5}) {
        CompositionFrames many(cpu::Isa::automatic, bake, settings, threads);
        scatterPixels(many, 6);
        one->program->reset();
        for (int frame = 0; frame < 3; ++frame) {
            one->run();
            many.run();
            CHECK(sameBits(one->indirect, many.indirect));
        }
    }
}

} // namespace rebound::test
