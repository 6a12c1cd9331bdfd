// SPDX-License-Identifier: MIT
#include "lab/charts/fronts.hpp"
#include "lab/charts/pareto.hpp"
#include "lab/measure/measurement.hpp"
#include "made_results.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace rebound::charts {
namespace {

using Indices = std::vector<size_t>;

// From the definition: each point against each other one.
Indices frontByBruteForce(const std::vector<SpeedAndError>& points) {
    Indices front;
    for (size_t i = 0; i < points.size(); ++i) {
        bool isBeaten = false;
        for (const SpeedAndError& other : points)
            isBeaten = isBeaten ||
                       (other.milliseconds <= points[i].milliseconds && other.error <= points[i].error &&
                        (other.milliseconds != points[i].milliseconds || other.error != points[i].error));
        if (!isBeaten) front.push_back(i);
    }
    return front;
}

TEST_CASE("a front holds what nothing beats, from the fastest") {
    CHECK(paretoFront({}).empty());
    CHECK(paretoFront({{1, 1}}) == Indices{0});
    CHECK(paretoFront({{3, 1}, {1, 3}, {2, 2}}) == Indices{1, 2, 0});
    CHECK(paretoFront({{1, 1}, {2, 2}, {1, 2}, {2, 1}}) == Indices{0});
    CHECK(paretoFront({{1, 1}, {1, 1}}) == Indices{0, 1});         // equal ones do not beat each other
    CHECK(paretoFront({{1, 2}, {2, 2}, {2, 1}}) == Indices{0, 2}); // slower and no better
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(paretoFront({{1, NAN}, {NAN, 0}, {infinity, 0}, {2, 2}}) == Indices{3});
}

TEST_CASE("a front is what each point against each other gives") {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        std::vector<SpeedAndError> points(random() % 30);
        for (SpeedAndError& point : points) // few values, so that many are equal
            point = {double(1 + random() % 6), double(1 + random() % 6)};
        Indices front = paretoFront(points);
        CHECK(std::is_sorted(front.begin(), front.end(), [&](size_t a, size_t b) {
            return points[a].milliseconds < points[b].milliseconds;
        }));
        std::sort(front.begin(), front.end());
        CHECK(front == frontByBruteForce(points));
    }
}

TEST_CASE("percentiles lie between sorted values in proportion") {
    const measure::Series five{"frame", {50, 10, 40, 20, 30}};
    CHECK(five.median() == 30.0);
    CHECK(five.minimum() == 10.0);
    CHECK(five.percentile(10) == doctest::Approx(14.0)); // 0.4 of the way from 10 to 20
    CHECK(five.percentile(90) == doctest::Approx(46.0));
    CHECK(five.percentile(0) == 10.0);
    CHECK(five.percentile(100) == 50.0);
    const measure::Series two{"frame", {4, 1}};
    CHECK(two.median() == 2.5);
    const measure::Series one{"frame", {7}};
    CHECK(one.percentile(10) == 7.0);
    CHECK(one.median() == 7.0);
}

TEST_CASE("a geometric mean is the root of the product") {
    CHECK(geometricMean({2.0, 8.0}) == doctest::Approx(4.0));
    CHECK(geometricMean({3.0}) == doctest::Approx(3.0));
    CHECK(geometricMean({1.0, 10.0, 100.0}) == doctest::Approx(10.0));
}

const ChartPoint& pointOf(const Chart& chart, const std::string& name, const std::string& group) {
    const auto found = std::find_if(chart.points.begin(), chart.points.end(), [&](const ChartPoint& p) {
        return p.name == name && p.group.starts_with(group);
    });
    REQUIRE(found != chart.points.end());
    return *found;
}

TEST_CASE("one chart a view, and one of geometric means over all, each with a front for each device") {
    const std::vector<Chart> charts = chartsOf(madeResults());
    REQUIRE(charts.size() == 3);
    CHECK(charts[0].fileName == "chart");
    CHECK(charts[1].fileName == "chart-atrium-nave");
    for (const Chart& chart : charts) {
        REQUIRE(chart.points.size() == 5);
        CHECK(pointOf(chart, "fast", "cpu").isOnFront);
        CHECK(!pointOf(chart, "middling", "cpu").isOnFront);
        CHECK(pointOf(chart, "slow", "cpu").isOnFront); // though the other device is faster
        CHECK(pointOf(chart, "slow", "vulkan").isOnFront);
    }
    // Both views' times and errors are 1 and 1.5 times the same.
    CHECK(pointOf(charts[0], "fast", "cpu").times.median == doctest::Approx(2.0 * std::sqrt(1.5)));
    CHECK(pointOf(charts[0], "slow", "cpu").error == doctest::Approx(0.1 * std::sqrt(1.5)));
}

TEST_CASE("what one view lacks is in no mean over all, and what has no logarithm is in no chart") {
    Results results = madeResults();
    results.points.pop_back();
    CHECK(chartsOf(results)[0].points.size() == 4);
    results.points[0].metrics.relativeRmse = 0.0;
    results.points[1].metrics.relativeRmse = NAN;
    CHECK(chartsOf(results)[0].points.size() == 2);
    CHECK(chartsOf(results)[1].points.size() == 3);
}

TEST_CASE("settings that are beaten in every view are named, with what beats them") {
    Results results = madeResults();
    const std::vector<Dominated> all = dominatedEverywhere(results);
    REQUIRE(all.size() == 1);
    CHECK(all[0].name == "middling");
    CHECK(all[0].by == "fast");
    CHECK(all[0].viewsOfThat == 2);
    CHECK(all[0].views == 2);
    for (Point& point : results.points)
        if (point.name == "middling" && point.view == "cornell front")
            point.metrics.relativeRmse = 0.01; // in one view it is the best
    CHECK(dominatedEverywhere(results).empty());
}

} // namespace
} // namespace rebound::charts
