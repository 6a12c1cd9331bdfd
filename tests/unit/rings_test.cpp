// SPDX-License-Identifier: MIT
// Rings: their texels tile the screen, and few samples stand for all of them.
#include "rebound/math/rings.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace rebound {
namespace {

double sumOfWeights(const std::vector<RingTexel>& texels) {
    double sum = 0.0;
    for (const RingTexel& t : texels) sum += t.weight;
    return sum;
}

constexpr Extent2D endless{4096, 4096};

} // namespace

TEST_CASE("a disc holds the texels within its radius but for the receiver, a ring those that the finer disc "
          "leaves out") {
    for (float radius : {1.0f, 3.0f, 12.5f, 40.0f}) {
        int inside = 0;
        for (int y = -50; y <= 50; ++y)
            for (int x = -50; x <= 50; ++x) inside += float(x * x + y * y) <= radius * radius ? 1 : 0;
        const auto disc = ringTexels({radius, true, false}, endless);
        CHECK(int(disc.size()) == inside - 1);
        for (const RingTexel& t : disc) CHECK(t.weight == 1.0f);
    }
    // The ring and the finer level's disc, of texels a quarter as large, together cover this level's disc.
    for (float radius : {8.0f, 40.0f}) {
        const double disc = sumOfWeights(ringTexels({radius, true, false}, endless));
        const double finer = disc + 1.0; // texels of the finer level, the receiver's with them
        const double ring = sumOfWeights(ringTexels({radius, false, false}, endless));
        CHECK(ring == doctest::Approx(disc + 1.0 - finer / 4.0).epsilon(1e-5)); // weights are floats
    }
}

TEST_CASE("an open ring reaches every texel of the level") {
    const Extent2D level{23, 11};
    const auto ring = ringTexels({4.0f, false, true}, level);
    std::set<std::pair<int, int>> offsets;
    for (const RingTexel& t : ring) {
        CHECK((std::abs(t.offset.x) < 23 && std::abs(t.offset.y) < 11));
        CHECK(offsets.insert({t.offset.x, t.offset.y}).second);
    }
    CHECK(offsets.contains({22, 10}));
    CHECK(offsets.contains({-22, -10}));
    // All offsets, less what a disc of 4 texels of half the size covers.
    const double finer = sumOfWeights(ringTexels({4.0f, true, false}, endless)) + 1.0;
    CHECK(sumOfWeights(ring) == doctest::Approx(45.0 * 21.0 - finer / 4.0).epsilon(1e-5));
}

TEST_CASE("samples stand for all texels: their weights add up to them") {
    for (auto [radius, isDisc, isOpen] : {std::tuple{40.0f, true, false},
                                          {40.0f, false, false},
                                          {12.0f, false, true},
                                          {1.0f, true, false},
                                          {1.0f, false, false}})
        for (Extent2D level :
             {Extent2D{320, 180}, Extent2D{15, 9}, Extent2D{1, 1}, Extent2D{1, 40}, Extent2D{2, 1}})
            for (int samples : {4, 32, 256}) {
                const Ring ring{radius, isDisc, isOpen};
                const auto texels = ringTexels(ring, level), pattern = ringPattern(ring, samples, level);
                CHECK(int(pattern.size()) <= samples);
                CHECK(pattern.empty() == texels.empty());
                // Sums of floats.
                CHECK(sumOfWeights(pattern) == doctest::Approx(sumOfWeights(texels)).epsilon(1e-5));
                std::set<std::pair<int, int>> among, offsets;
                for (const RingTexel& t : texels) among.insert({t.offset.x, t.offset.y});
                for (const RingTexel& t : pattern) {
                    CHECK(t.weight > 0.0f);
                    CHECK(among.contains({t.offset.x, t.offset.y}));
                    CHECK(offsets.insert({t.offset.x, t.offset.y}).second);
                }
                if (texels.size() <= size_t(samples)) CHECK(pattern.size() == texels.size());
            }
}

TEST_CASE("a pattern is the same each time") {
    const auto once = ringPattern({40.0f, false, false}, 64, {320, 180}),
               again = ringPattern({40.0f, false, false}, 64, {320, 180});
    REQUIRE(once.size() == again.size());
    for (size_t i = 0; i < once.size(); ++i)
        CHECK((once[i].offset == again[i].offset && once[i].weight == again[i].weight));
}

} // namespace rebound
