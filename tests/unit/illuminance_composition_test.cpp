// SPDX-License-Identifier: MIT
// What pixels receive of caches, against closed forms.
#include "composition_checks.hpp"

#include <cmath>

namespace rebound::test {

TEST_CASE("composition: a constant sphere of radiance 1 gives E = pi at every normal, inside the grid and "
          "outside") {
    for (uint32_t bands : {2u, 3u, 4u})
        for (LinkForm form : {LinkForm::coefficients, LinkForm::direction}) {
            MadeBake made = gridInView();
            made.bands = bands;
            made.linkForm = form;
            for (MadeCache& cache : made.caches) linkAround(cache, 1.0f);
            const Bake bake = made.pack();
            for (cpu::Isa isa : cpu::availableIsas()) {
                CompositionFrames frames(isa, bake, settingsFor(bake));
                scatterPixels(frames, bands);
                frames.run();
                checkEverywhere(frames, glm::vec3(1.0f), single);
            }
        }
}

TEST_CASE("composition: links of a cosine sky give its irradiance") {
    // Radiance 1 + d . up: coefficients 1 of y_0 and, of band 1, a third of sqrt(3) up, over the largest there can be: up / 3.
    const glm::vec3 up(1.0f, 0.0f, 0.0f); // x is coefficient 3
    for (uint32_t bands : {2u, 3u, 4u}) {
        MadeBake made = gridInView();
        made.bands = bands;
        const int steps = bands == 2 ? 511 : 127;
        for (MadeCache& cache : made.caches) {
            MadeLink link{0, factorOfSphere(), {}, up};
            link.shape[3] = int(std::lround(float(steps) / 3.0f));
            cache.links.push_back(link);
        }
        const Bake bake = made.pack();
        for (cpu::Isa isa : cpu::availableIsas()) {
            CompositionFrames frames(isa, bake, settingsFor(bake));
            scatterPixels(frames, 5);
            frames.run();
            for (int y = 0; y < 7; ++y)
                for (int x = 0; x < 19; ++x)
                    // Half a step of the stored number, times 2.
                    CHECK(std::abs(frames.indirect.at(x, y, 0) -
                                   (1.0f + 2.0f / 3.0f * glm::dot(up, frames.normalAt(x, y)))) <=
                          1.0f / float(steps) + 1e-5f);
        }
    }
}

TEST_CASE("composition: a cache behind the receiver's tangent plane takes no part, where it really stands") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) {
        const bool isEven = std::lround(cache.place.x) % 2 == 0;
        linkAround(cache, isEven ? 1.0f : 5.0f);
    }
    const auto run = [&](const MadeBake& bakeOf, glm::vec3 normal) {
        const Bake bake = bakeOf.pack();
        std::vector<float> results;
        for (cpu::Isa isa : cpu::availableIsas()) {
            CompositionFrames frames(isa, bake, settingsFor(bake, {10, 1}));
            frames.setNormals(normal);
            frames.run();
            results.push_back(frames.indirect.at(3, 0, 0)); // x = 2.5: between caches of 1 and of 5
        }
        return results;
    };
    for (float value : run(made, {1, 0, 0}))
        CHECK(value == doctest::Approx(5.0f).epsilon(1e-5)); // shares of 1e-6
    for (float value : run(made, {-1, 0, 0})) CHECK(value == doctest::Approx(1.0f).epsilon(1e-5));
    for (float value : run(made, {0, 1, 0})) CHECK(value == doctest::Approx(3.0f).epsilon(1e-5));
    for (MadeCache& cache : made.caches)
        if (std::lround(cache.place.x) == 2) cache.place.x = 2.9f; // in front of the receiver now
    for (float value : run(made, {1, 0, 0})) CHECK(value == doctest::Approx(3.0f).epsilon(1e-5));
}

TEST_CASE("composition: baked receivers cut off caches that they do not see, for receivers like them") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) linkAround(cache, std::lround(cache.place.x) % 2 == 0 ? 1.0f : 5.0f);
    for (MadeCell& cell : made.cells) {
        MadeReceiver receiver{{0.5f, 0.5f, 0.5f}, {0, 1, 0}, {}};
        for (size_t k = 0; k < 8; ++k)
            receiver.shares[k] = (k & 1) == cell.place.x % 2 ? 255 : 0; // those of 1
        cell.receivers.push_back(receiver);
    }
    const Bake bake = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        CompositionFrames frames(isa, bake, settingsFor(bake, {10, 10}));
        frames.setNormals({0, 1, 0});
        frames.run();
        // The receiver is the baked one: the others' share is the prior's, 1e-3, of a weight of 1.
        for (int x = 1; x < 9; ++x)
            CHECK(std::abs(frames.indirect.at(x, 4, 0) - (1.0f + 4.0f * 0.001f)) < 2e-4f);
        // Receivers that look the other way know nothing of it.
        frames.setNormals({0, -1, 0});
        frames.run();
        for (int x = 1; x < 9; ++x) CHECK(frames.indirect.at(x, 4, 0) == doctest::Approx(3.0f).epsilon(1e-5));
    }
}

TEST_CASE("composition: where every cache is behind or hidden, light is neither black nor NaN") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) {
        linkAround(cache, std::lround(cache.place.x) % 2 == 0 ? 1.0f : 5.0f);
        cache.place.z += 100.0f; // behind all that look down
    }
    for (bool isHidden : {false, true}) {
        if (isHidden)
            for (MadeCell& cell : made.cells) cell.receivers.push_back({glm::vec3(0.5f), {0, 0, -1}, {}});
        const Bake bake = made.pack();
        for (cpu::Isa isa : cpu::availableIsas()) {
            CompositionFrames frames(isa, bake, settingsFor(bake, {10, 10}));
            frames.setNormals({0, 0, -1});
            frames.run();
            for (int x = 1; x < 9; ++x)
                CHECK(frames.indirect.at(x, 4, 0) == doctest::Approx(3.0f).epsilon(1e-4));
        }
    }
}

TEST_CASE("composition: pixels outside the grid receive what its border does") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) linkAround(cache, 1.0f + cache.place.x);
    const Bake bake = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        CompositionFrames frames(isa, bake, settingsFor(bake, {20, 1}));
        frames.depth.at(19, 0, 0) = 1000.0f; // far behind it
        frames.run();
        for (int x = 0; x < 20; ++x) {
            const float inside = std::min(std::max(frames.position(x, 0).x, 0.0f), 8.0f);
            CHECK(frames.indirect.at(x, 0, 0) ==
                  doctest::Approx(1.0f + inside).epsilon(1e-4)); // corners' share 1e-5
        }
    }
}

TEST_CASE("composition: cells without some caches use the others; without any, there is no light") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) linkAround(cache, std::lround(cache.place.x) % 2 == 0 ? 1.0f : 5.0f);
    for (MadeCell& cell : made.cells)
        for (size_t k = 0; k < 8; ++k) {
            if ((k & 1) == cell.place.x % 2) cell.caches[k] = 0xffffffffu; // those of 1
            if (cell.place.x == 3) cell.caches[k] = 0xffffffffu;
        }
    const Bake bake = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        CompositionFrames frames(isa, bake, settingsFor(bake, {10, 10}));
        frames.run();
        for (int x = 1; x < 9; ++x)
            CHECK(frames.indirect.at(x, 4, 0) == doctest::Approx(x == 4 ? 0.0f : 5.0f).epsilon(1e-5));
    }
}

TEST_CASE("composition: bricks without cells use those of a filled one") {
    MadeBake made = gridInView();
    for (MadeCache& cache : made.caches) linkAround(cache, 2.0f);
    // Cells of one brick alone remain; all others stand for it.
    made.cellOfBrick.resize(64);
    made.cells.resize(64);
    std::fill(made.brickOf.begin(), made.brickOf.end(), 0u);
    const Bake bake = made.pack();
    for (cpu::Isa isa : cpu::availableIsas()) {
        CompositionFrames frames(isa, bake, settingsFor(bake));
        scatterPixels(frames, 9);
        frames.run();
        checkEverywhere(frames, glm::vec3(2.0f), 2.0 * single);
    }
}

} // namespace rebound::test
