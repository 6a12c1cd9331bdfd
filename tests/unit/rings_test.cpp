// SPDX-License-Identifier: MIT
// Rings: their texels tile the screen, and few samples stand for all of them.
#include "rebound/math/rings.hpp"

#include <doctest/doctest.h>

#include <cmath>
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

TEST_CASE("samples stand for all texels: the patterns' mean weight is theirs") {
    for (auto [radius, isDisc, isOpen] : {std::tuple{40.0f, true, false},
                                          {40.0f, false, false},
                                          {12.0f, false, true},
                                          {1.0f, true, false},
                                          {1.0f, false, false}})
        for (Extent2D level :
             {Extent2D{320, 180}, Extent2D{15, 9}, Extent2D{1, 1}, Extent2D{1, 40}, Extent2D{2, 1}})
            for (int samples : {4, 32, 256})
                for (int count : {1, 4}) {
                    const Ring ring{radius, isDisc, isOpen};
                    const auto texels = ringTexels(ring, level);
                    const RingPatterns patterns = ringPatterns(ring, samples, count, level);
                    const int stored = patterns.isShared ? 1 : 4;
                    CHECK(patterns.count <= samples);
                    CHECK((patterns.count == 0) == texels.empty());
                    REQUIRE(int(patterns.texels.size()) == stored * patterns.count);
                    if (count == 1) CHECK(patterns.isShared);
                    // Sums of floats.
                    CHECK(sumOfWeights(patterns.texels) / stored ==
                          doctest::Approx(sumOfWeights(texels)).epsilon(1e-5));
                    std::set<std::pair<int, int>> among;
                    for (const RingTexel& t : texels) among.insert({t.offset.x, t.offset.y});
                    for (const RingTexel& t : patterns.texels) {
                        CHECK(t.weight > 0.0f);
                        CHECK(among.contains({t.offset.x, t.offset.y}));
                    }
                    if (texels.size() <= size_t(samples)) CHECK(patterns.texels.size() == texels.size());
                }
}

TEST_CASE("the four patterns share no texel where cells are large, and each covers every direction alike") {
    const RingPatterns patterns = ringPatterns({40.0f, false, false}, 64, 4, endless);
    REQUIRE(patterns.count == 64);
    std::set<std::pair<int, int>> offsets;
    for (const RingTexel& t : patterns.texels) CHECK(offsets.insert({t.offset.x, t.offset.y}).second);
    // A half plane holds half of the ring. Its edge cuts some ten of 64 cells, each in a place that differs by the
    // pattern: a tenth of the weight may fall to the other side.
    for (int pattern = 0; pattern < 4; ++pattern)
        for (int direction = 0; direction < 16; ++direction) {
            const double angle = direction * std::numbers::pi / 8.0;
            double side = 0.0, all = 0.0;
            for (int i = pattern * 64; i < pattern * 64 + 64; ++i) {
                const RingTexel& t = patterns.texels[size_t(i)];
                all += t.weight;
                if (t.offset.x * std::cos(angle) + t.offset.y * std::sin(angle) > 0.0) side += t.weight;
            }
            CHECK(side / all == doctest::Approx(0.5).epsilon(0.2));
        }
}

TEST_CASE("four patterns find a smooth light's sum more nearly than one") {
    // Light of a disc far from the receiver, and bands of ten texels.
    const auto light = [](glm::ivec2 o) {
        const double distance = std::hypot(o.x - 9.0, o.y - 5.0);
        return std::exp(-distance * distance / 200.0) + 0.5 + 0.5 * std::sin(0.6 * o.x + 0.3 * o.y);
    };
    const auto sumOf = [&](const std::vector<RingTexel>& texels) {
        double sum = 0.0;
        for (const RingTexel& t : texels) sum += t.weight * light(t.offset);
        return sum;
    };
    double one = 0.0, four = 0.0;
    for (float radius : {24.0f, 32.0f, 40.0f, 48.0f})
        for (bool isDisc : {true, false}) {
            const Ring ring{radius, isDisc, false};
            const double whole = sumOf(ringTexels(ring, endless));
            one += std::abs(sumOf(ringPatterns(ring, 64, 1, endless).texels) / whole - 1.0) / 8.0;
            four += std::abs(sumOf(ringPatterns(ring, 64, 4, endless).texels) / 4.0 / whole - 1.0) / 8.0;
        }
    CHECK(one < 0.1);
    CHECK(four < 0.5 * one);
}

TEST_CASE("patterns are the same each time") {
    const auto once = ringPatterns({40.0f, false, false}, 64, 4, {320, 180}),
               again = ringPatterns({40.0f, false, false}, 64, 4, {320, 180});
    REQUIRE(once.texels.size() == again.texels.size());
    for (size_t i = 0; i < once.texels.size(); ++i)
        CHECK((once.texels[i].offset == again.texels[i].offset &&
               once.texels[i].weight == again.texels[i].weight));
}

TEST_CASE("wide rings are cut in blocks: a thousand texels wide, they cost little more than narrow ones") {
    const Ring wide{1024.0f, false, true};
    const RingPatterns patterns = ringPatterns(wide, 256, 4, {2048, 2048});
    CHECK(patterns.count == 256);
    double sum = 0.0;
    for (const RingTexel& t : patterns.texels) {
        sum += t.weight / 4.0;
        CHECK(std::hypot(double(t.offset.x), double(t.offset.y)) <= 1024.01);
        CHECK(std::hypot(double(t.offset.x), double(t.offset.y)) >= 510.0);
    }
    // pi (1024^2 - 512^2) texels; sums of floats.
    CHECK(sum == doctest::Approx(std::numbers::pi * 786432.0).epsilon(1e-3));
}

} // namespace rebound
