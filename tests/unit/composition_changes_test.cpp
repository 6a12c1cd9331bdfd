// SPDX-License-Identifier: MIT
// Light that did not change: the same bits as computing it again, and nothing computed; light sent by the host.
#include "composition_frame.hpp"
#include "random_bake.hpp"

#include <cmath>
#include <limits>

namespace rebound::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

void scatterPixels(CompositionFrames& frames) {
    Numbers32 random(12);
    for (int y = 0; y < frames.settings.resolution.height; ++y)
        for (int x = 0; x < frames.settings.resolution.width; ++x) {
            frames.depth.at(x, y, 0) = random.within(0.05f, 9.0f);
            const glm::vec3 n = random.direction();
            for (int c = 0; c < 3; ++c) frames.normal.at(x, y, c) = n[c];
        }
}

float settled(const CompositionFrames& frames) { return floatsOf(*frames.program->read("settled"))[0]; }

// The same frames with and without skipping.
struct Pair {
    CompositionFrames every, skipping;

    Pair(cpu::Isa isa, const Bake& bake, IlluminanceCompositionSettings settings)
        : every(isa, bake, settings, 2), skipping(isa, bake, skippingOf(settings), 3) {
        for (CompositionFrames* f : {&every, &skipping}) {
            scatterPixels(*f);
            Numbers32 random(77);
            for (float& l : f->light) l = random.within(0.0f, 3.0f);
            for (float& e : f->emission) e = random.within(0.0f, 1.0f);
        }
    }
    static IlluminanceCompositionSettings skippingOf(IlluminanceCompositionSettings s) {
        s.skipUnchanged = true;
        return s;
    }
    template <class Change>
    void change(Change change) {
        change(every);
        change(skipping);
    }
    void run() {
        every.run();
        skipping.run();
        CHECK(sameBits(every.indirect, skipping.indirect));
        CHECK(floatsOf(*every.program->read("caches")) == floatsOf(*skipping.program->read("caches")));
    }
    // Until nothing changes any more; returns after how many frames.
    int settle() {
        for (int frame = 1; frame <= 300; ++frame) {
            run();
            if (settled(skipping) == 1.0f) return frame;
        }
        return 301;
    }
};

// A bake whose caches receive about a third of what surfels send, so that bounces die down.
Bake dimBake(uint32_t surfels, uint32_t terms) {
    MadeBake made = randomBake(uint32_t(surfels), 3, LinkForm::coefficients, surfels, terms);
    for (MadeCache& cache : made.caches)
        for (MadeLink& link : cache.links) link.factor *= 0.1f;
    return made.pack();
}

} // namespace

TEST_CASE("unchanged light: skipping gives the same bits, whatever changes, and settles") {
    for (uint32_t surfels : {1u, 40u, 900u})
        for (bool bounces : {true, false})
            for (cpu::Isa isa : cpu::availableIsas()) {
                CAPTURE(std::string(cpu::name(isa)));
                CAPTURE(surfels);
                CAPTURE(bounces);
                const Bake bake = dimBake(surfels, 2 + surfels % 3);
                auto settings = settingsFor(bake);
                settings.bounces = bounces;
                settings.emission = true;
                settings.emissionOfFrame = surfels == 900;
                Pair pair(isa, bake, settings);
                CHECK(pair.settle() <= (bounces ? 100 : 2));
                for (int frame = 0; frame < 3; ++frame) {
                    pair.run();
                    CHECK(settled(pair.skipping) == 1.0f);
                }
                const size_t last = surfels - 1;
                pair.change([&](auto& f) { f.light[last] += 1.0f; });
                pair.run();
                CHECK(settled(pair.skipping) == 0.0f);
                CHECK(pair.settle() <= (bounces ? 100 : 2));
                // Next to nothing is something.
                pair.change([&](auto& f) { f.light[0] = std::nextafter(f.light[0], 9.0f); });
                CHECK(pair.settle() <= (bounces ? 100 : 2));
                // What is no number is nothing, and stays so.
                pair.change([&](auto& f) { f.light[0] = nan; });
                CHECK(pair.settle() <= (bounces ? 100 : 2));
                pair.run();
                CHECK(settled(pair.skipping) == 1.0f);
                pair.change([&](auto& f) { f.program->reset(); });
                CHECK(pair.settle() <= (bounces ? 100 : 3));
            }
}

TEST_CASE("unchanged light: from darkness on, and back into it") {
    const Bake bake = dimBake(130, 2);
    auto settings = settingsFor(bake);
    settings.bounces = settings.emission = true;
    Pair pair(cpu::Isa::automatic, bake, settings);
    const std::vector<float> light = pair.every.light;
    pair.change([](auto& f) { std::fill(f.light.begin(), f.light.end(), 0.0f); });
    pair.settle(); // the bake's emission
    for (int turn = 0; turn < 2; ++turn) {
        pair.change([&](auto& f) { f.light = light; });
        for (int frame = 0; frame < 5; ++frame) pair.run();
        pair.change([](auto& f) { std::fill(f.light.begin(), f.light.end(), 0.0f); });
        for (int frame = 0; frame < 5; ++frame) pair.run();
    }
}

TEST_CASE("unchanged light: what is skipped is not computed") {
    const Bake bake = dimBake(200, 2);
    for (cpu::Isa isa : cpu::availableIsas()) {
        auto settings = settingsFor(bake);
        settings.bounces = settings.emission = true;
        Pair pair(isa, bake, settings);
        // Planted numbers stay where nobody computes, and go where somebody does.
        for (const char* name : {"nodes", "caches"}) {
            pair.change([](auto& f) { f.program->reset(); }); // what was planted before is gone
            REQUIRE(pair.settle() <= 100);
            std::vector<std::byte> right = *pair.skipping.program->read(name), planted = right;
            float seven = 7.0f;
            const size_t inner = 4 * sizeof(float) * (std::string(name) == "nodes" ? 210 : 0);
            std::memcpy(&planted[inner], &seven, sizeof seven);
            REQUIRE(pair.skipping.program->write(name, planted));
            pair.skipping.run();
            CHECK(*pair.skipping.program->read(name) == planted);
            pair.skipping.light[3] += 0.5f;
            pair.skipping.run();
            pair.every.light = pair.skipping.light;
            CHECK(*pair.skipping.program->read(name) != planted);
        }
    }
}

TEST_CASE("unchanged light: the memory that it takes, and nothing of it without") {
    const Bake bake = dimBake(200, 2);
    auto settings = settingsFor(bake);
    settings.bounces = true;
    const Plan plain = *planIlluminanceComposition(settings);
    for (const char* name : {"kept", "settled", "settled parts", "surfel emission"})
        CHECK(plain.find(name) < 0);
    const size_t caches = bake.layout.caches * 28 * sizeof(float),
                 nodes = 4 * (bake.layout.nodes + 1) * sizeof(float);
    CHECK(memoryUse(plain)->persistent == caches);
    settings.skipUnchanged = true;
    CHECK(memoryUse(*planIlluminanceComposition(settings))->persistent ==
          caches + nodes + 4 * 256 * sizeof(float) + sizeof(float));
    settings.emissionOfFrame = true;
    CHECK(memoryUse(*planIlluminanceComposition(settings))->persistent ==
          caches + nodes + 7 * 256 * sizeof(float) + sizeof(float));
}

TEST_CASE("composition: emission of the frame is the bake's where it is the same, and may change") {
    const MadeBake made = randomBake(8, 3, LinkForm::coefficients, 100, 2);
    const Bake bake = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        auto settings = settingsFor(bake);
        settings.bounces = settings.emission = true;
        CompositionFrames baked(isa, bake, settings);
        settings.emissionOfFrame = true;
        CompositionFrames handed(isa, bake, settings);
        Pair pair(isa, bake, settings);
        scatterPixels(baked);
        scatterPixels(handed);
        const auto words = bake.section(BakeSection::surfels);
        for (uint32_t i = 0; i < 100; ++i) {
            const glm::vec3 e = unpackEmission(words[6 * 128 + i]);
            for (int c = 0; c < 3; ++c) handed.emission[size_t(128 * c) + i] = e[c];
        }
        for (int frame = 0; frame < 3; ++frame) {
            baked.run();
            handed.run();
            for (size_t i = 0; i < baked.indirect.values.size(); ++i)
                CHECK(handed.indirect.values[i] == doctest::Approx(baked.indirect.values[i]).epsilon(1e-5));
            // Television.
            pair.change([&](auto& f) { f.emission[5] = frame == 1 ? nan : float(frame); });
            pair.run();
        }
    }
}

} // namespace rebound::test
