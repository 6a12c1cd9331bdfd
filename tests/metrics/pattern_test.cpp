// SPDX-License-Identifier: MIT
// How much pattern a difference has, on pictures whose block means are known.
#include "test_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rebound::metrics {
namespace {

using doctest::Approx;

constexpr double rounding = 1e-6;  // of floats that hold the test's numbers
constexpr Extent2D extent{64, 48}; // 8 x 6 blocks

// A wall that faces the camera, unless a test changes it.
struct Wall {
    lab::Image depth = lab::Image(extent, 1, 4.0f);
    lab::Image normal = imageOf(extent, 3, [](int, int, int c) { return c == 2 ? 1.0 : 0.0; });

    CompareOptions options() const {
        CompareOptions options;
        options.surfaces = Surfaces{&depth, &normal};
        return options;
    }
};

// 2, and what `added` gives.
template <class Added>
lab::Image twoAnd(const Added& added) {
    return imageOf(extent, 3, [&](int x, int y, int c) { return 2.0 + added(x, y, c); });
}

const lab::Image truth(extent, 3, 2.0f);

double chessboard(int x, int y, int side) { return (x / side + y / side) % 2 == 0 ? 1.0 : -1.0; }

TEST_CASE("a chessboard of blocks has its own strength, and one of pixels none") {
    const Wall wall;
    const ErrorMetrics blocks =
        compared(twoAnd([](int x, int y, int) { return 0.5 * chessboard(x, y, 8); }), truth, wall.options());
    CHECK(blocks.smoothBlocks == 48);
    CHECK(blocks.pattern == Approx(0.5 / 2.0).epsilon(rounding));
    // The error is the same for both; the eye averages the latter.
    const ErrorMetrics noise =
        compared(twoAnd([](int x, int y, int) { return 0.5 * chessboard(x, y, 1); }), truth, wall.options());
    CHECK(noise.relativeRmse == Approx(blocks.relativeRmse).epsilon(rounding));
    CHECK(noise.pattern < rounding);
}

TEST_CASE("light that is missing everywhere alike is no pattern") {
    const Wall wall;
    CHECK(compared(twoAnd([](int, int, int) { return -0.75; }), truth, wall.options()).pattern < rounding);
}

TEST_CASE("channels have patterns of their own") {
    const Wall wall;
    // +-0.6 in one of three channels: its variance is a third of the mean.
    const lab::Image red =
        twoAnd([](int x, int y, int c) { return c == 0 ? 0.6 * chessboard(x, y, 8) : 0.0; });
    CHECK(compared(red, truth, wall.options()).pattern == Approx(0.3 / std::sqrt(3.0)).epsilon(rounding));
}

TEST_CASE("blocks with an edge, without a surface or masked out do not count") {
    Wall wall;
    lab::Image mask(extent, 1, 1.0f);
    *wall.depth.at(3, 3) = 0.0f;      // block 0, 0: a hole
    *wall.depth.at(12, 3) = INFINITY; // block 1, 0: sky
    for (int y = 0; y < 8; ++y)       // block 2, 0: a step in depth
        for (int x = 20; x < 24; ++x) *wall.depth.at(x, y) = 5.0f;
    for (int y = 0; y < 8; ++y) // block 3, 0: a corner
        for (int x = 28; x < 32; ++x)
            std::copy_n(std::array{1.0f, 0.0f, 0.0f}.data(), 3, wall.normal.at(x, y));
    *mask.at(33, 1) = 0.0f; // block 4, 0
    lab::Image test = twoAnd([](int x, int y, int) { return 0.5 * chessboard(x, y, 8); });
    test.at(41, 1)[1] = NAN; // block 5, 0
    // A strong pattern in the first four of these blocks, which does not show.
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 32; ++x) test.at(x, y)[0] = 2.0f + float(x / 8);
    // And light that is not what the pattern is measured by.
    lab::Image brightThere = truth;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 32; ++x) brightThere.at(x, y)[1] = 50.0f;
    CompareOptions options = wall.options();
    options.mask = &mask;
    const ErrorMetrics m = compared(test, brightThere, options);
    CHECK(m.smoothBlocks == 48 - 6);
    // Of six blocks left out, three had +0.5 and three -0.5; the truth is 2 in all others.
    CHECK(m.pattern == Approx(0.25).epsilon(rounding));
}

TEST_CASE("planes at any angle and round columns are smooth") {
    const lab::Image test = twoAnd([](int x, int y, int) { return 0.5 * chessboard(x, y, 8); });
    Wall floor; // seen at a degree: depth from 1 m to 48 m
    floor.depth = imageOf(extent, 1, [](int, int y, int) { return 48.0 / double(y + 1); });
    CHECK(compared(test, truth, floor.options()).smoothBlocks == 48);
    // Columns side by side, their axes 10 m away.
    const auto columns = [&](double radius) {
        Wall wall;
        const auto sine = [=](int x) { return std::fmod(double(x) + 0.5, 2.0 * radius) / radius - 1.0; };
        const auto cosine = [=](int x) { return std::sqrt(1.0 - sine(x) * sine(x)); };
        wall.depth = imageOf(extent, 1, [&](int x, int, int) { return 10.0 - cosine(x); });
        wall.normal = imageOf(extent, 3, [&](int x, int, int c) {
            return c == 0 ? sine(x) : c == 2 ? cosine(x) : 0.0;
        });
        return compared(test, truth, wall.options()).smoothBlocks;
    };
    CHECK(columns(32.0) == 48); // turn by 7.5 degrees at most from pixel to pixel
    Wall thin;                  // of 16 pixels, turn by 15 degrees at their sides
    thin.normal = imageOf(extent, 3, [](int x, int, int c) {
        const double sine = (double(x % 16) + 0.5) / 8.0 - 1.0;
        return c == 0 ? sine : c == 2 ? std::sqrt(1.0 - sine * sine) : 0.0;
    });
    const auto refused = compareImages(test, truth, thin.options());
    CHECK_FALSE(refused);
}

TEST_CASE("halves take the truth's noise out of the pattern") {
    // Noise of whole blocks, which means do not remove: +-1 in one half, and in the other in another order.
    const lab::Image a = twoAnd([](int x, int, int) { return (x / 8) % 2 == 0 ? 1.0 : -1.0; });
    const lab::Image b = twoAnd([](int x, int, int) { return (x / 16) % 2 == 0 ? 1.0 : -1.0; });
    lab::Image mean = a;
    for (size_t i = 0; i < mean.data.size(); ++i) mean.data[i] = 0.5f * (a.data[i] + b.data[i]);
    const lab::Image test = twoAnd([](int, int y, int) { return (y / 8) % 2 == 0 ? 0.5 : -0.5; });
    const Wall wall;
    CompareOptions options = wall.options();
    CHECK(compared(test, mean, options).pattern > 0.4);
    options.halves = TruthHalves{&a, &b};
    CHECK(compared(test, mean, options).pattern == Approx(0.25).epsilon(rounding));
}

TEST_CASE("without surfaces there is no pattern, and surfaces have to fit") {
    CHECK(std::isnan(compared(truth, truth).pattern));
    const auto refusal = [](const Wall& wall) {
        const auto result = compareImages(truth, truth, wall.options());
        REQUIRE_FALSE(result);
        return result.error().message;
    };
    Wall wall;
    wall.depth = lab::Image({64, 47}, 1, 1.0f);
    CHECK(refusal(wall).find("depth is 64x47") != std::string::npos);
    wall = Wall();
    wall.normal = lab::Image(extent, 1);
    CHECK(refusal(wall).find("normal is 64x48 pixels with 1 channel") != std::string::npos);
    wall = Wall();
    wall.depth = lab::Image(extent, 1);
    CHECK(refusal(wall).find("smooth surface") != std::string::npos);
}

} // namespace
} // namespace rebound::metrics
