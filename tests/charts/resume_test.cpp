// SPDX-License-Identifier: MIT
#include "../lab/temporary_folder.hpp"
#include "lab/charts/file_lock.hpp"
#include "lab/charts/report.hpp"
#include "made_workshop.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace rebound::charts {
namespace {

namespace fs = std::filesystem;

struct Chart {
    Sweep sweep = madeSweep();
    std::vector<View> views = madeViews();
    std::vector<ChartBackend> backends = madeBackends();
    std::vector<Peer> peers;
    std::string machine = "a machine";
    std::string version = REBOUND_VERSION;
    bool fresh = false;

    Result<Results> run(const fs::path& folder, MadeWorkshop& workshop) {
        auto store = PointStore::open(folder, version, fresh);
        if (!store) return store.error();
        return runChart({sweep, views, backends, peers, machine, "half"}, workshop, *store);
    }
    // How many measurements another run makes.
    size_t measurementsOf(const fs::path& folder) {
        MadeWorkshop workshop(sweep.size);
        const auto results = run(folder, workshop);
        REQUIRE_MESSAGE(results, results.error().message);
        return workshop.measured.size();
    }
};

TEST_CASE("each setting is measured once in each view, and its figures are those of its frames") {
    const lab::TemporaryFolder folder;
    Chart chart;
    MadeWorkshop workshop(chart.sweep.size);
    const auto results = chart.run(folder.path(), workshop);
    REQUIRE_MESSAGE(results, results.error().message);
    CHECK(workshop.measured == std::vector<std::string>{"box front quarter-16", "box front quarter-32",
                                                        "box side quarter-16", "box side quarter-32"});
    REQUIRE(results->points.size() == 4);
    const Point& point = results->points[0];
    CHECK(point.times.median == 2.0);
    CHECK(point.times.minimum == 1.0);
    CHECK(point.times.percentile10 == doctest::Approx(1.2));
    CHECK(point.times.percentile90 == doctest::Approx(2.8));
    CHECK(point.times.frames == 3);
    // Everywhere 2.4 in place of 2: an error of 0.4 over a mean of 2.
    CHECK(point.metrics.relativeRmse == doctest::Approx(0.2).epsilon(1e-5));
    CHECK(point.metrics.pixels == 32);
    CHECK(results->views[1].label == "box side");
    CHECK(results->views[0].errorScale == 2.0);
    for (const char* name :
         {"sheet-box-front.png", "view-box-front-key-of-front.png", "view-box-side-key-of-side-direct.png"})
        CHECK(fs::is_regular_file(folder / "pictures" / name));
    CHECK(fs::is_regular_file(folder / "points" / (point.picture + ".exr")));
}

TEST_CASE("a finished chart measures nothing again, and gives the same results") {
    const lab::TemporaryFolder folder;
    Chart chart;
    MadeWorkshop first(chart.sweep.size), second(chart.sweep.size);
    const auto results = chart.run(folder.path(), first);
    const auto again = chart.run(folder.path(), second);
    REQUIRE(results);
    REQUIRE_MESSAGE(again, again.error().message);
    CHECK(first.measured.size() == 4);
    CHECK(second.measured.empty());
    CHECK(nlohmann::json(toJson(*again)) == nlohmann::json(toJson(*results)));
}

TEST_CASE("an interrupted chart goes on where it stopped") {
    const lab::TemporaryFolder folder;
    Chart chart;
    MadeWorkshop broken(chart.sweep.size), whole(chart.sweep.size);
    broken.failsAfter = 3;
    const auto failed = chart.run(folder.path(), broken);
    REQUIRE(!failed);
    CHECK(failed.error().message == "the device was lost");
    REQUIRE(chart.run(folder.path(), whole));
    CHECK(whole.measured == std::vector<std::string>{"box side quarter-32"});
}

TEST_CASE("a point is measured again when anything that it depends on is another") {
    const lab::TemporaryFolder folder;
    Chart chart;
    CHECK(chart.measurementsOf(folder.path()) == 4);
    SUBCASE("a further setting") {
        chart.sweep = *parseSweep(
            R"({"techniques": {"screen_indirect": [{"samples": [16, 32, 64]}]}, "size": "8x4", "frames": 3})",
            "sweep");
        CHECK(chart.measurementsOf(folder.path()) == 2);
    }
    SUBCASE("what a view shows") {
        chart.views[1].contentKey = "another";
        CHECK(chart.measurementsOf(folder.path()) == 2);
    }
    SUBCASE("frames") {
        chart.sweep.frames = 4;
        CHECK(chart.measurementsOf(folder.path()) == 4);
    }
    SUBCASE("the reference") {
        chart.sweep.reference.samples = 1024;
        CHECK(chart.measurementsOf(folder.path()) == 4);
    }
    SUBCASE("the device") {
        chart.backends[0].device = "avx2 on 1 thread";
        CHECK(chart.measurementsOf(folder.path()) == 4);
    }
    SUBCASE("the machine") {
        chart.machine = "another machine";
        CHECK(chart.measurementsOf(folder.path()) == 4);
    }
    SUBCASE("the code of a kernel, or of what runs it") {
        chart.backends[0].source = "hash-of-another-source";
        CHECK(chart.measurementsOf(folder.path()) == 4);
    }
    SUBCASE("a picture that is gone") {
        for (const auto& entry : fs::directory_iterator(folder / "pictures"))
            if (entry.path().string().find("box-side-quarter-16") != std::string::npos)
                fs::remove(entry.path());
        CHECK(chart.measurementsOf(folder.path()) == 1);
    }
    SUBCASE("a fresh start") {
        chart.fresh = true;
        CHECK(chart.measurementsOf(folder.path()) == 4);
    }
    SUBCASE("nothing") { CHECK(chart.measurementsOf(folder.path()) == 0); }
}

TEST_CASE("results from another version, and files that are none, are refused in one sentence") {
    const lab::TemporaryFolder folder;
    Chart chart;
    CHECK(chart.measurementsOf(folder.path()) == 4);
    SUBCASE("another version") {
        chart.version = "99.0";
        MadeWorkshop workshop(chart.sweep.size);
        const auto results = chart.run(folder.path(), workshop);
        REQUIRE(!results);
        for (const char* text : {"points", REBOUND_VERSION, "99.0", "--fresh", "--out"})
            CHECK(results.error().message.find(text) != std::string::npos);
        CHECK(workshop.measured.empty());
        chart.fresh = true;
        CHECK(chart.run(folder.path(), workshop));
    }
    SUBCASE("not a point") {
        for (const char* text :
             {"", "{", "{}", R"({"format": 1, "version": ")" REBOUND_VERSION R"(", "key": 1, "point": {}})",
              R"({"format": "one"})"}) {
            lab::writeText(folder / "points" / "broken.json", text);
            MadeWorkshop workshop(chart.sweep.size);
            const auto results = chart.run(folder.path(), workshop);
            REQUIRE(!results);
            CHECK(results.error().message.find("broken.json") != std::string::npos);
            CHECK(results.error().message.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("pixels that are not finite are counted and named, and in no mean") {
    const lab::TemporaryFolder folder;
    Chart chart;
    MadeWorkshop workshop(chart.sweep.size);
    workshop.firstValue = NAN;
    const auto results = chart.run(folder.path(), workshop);
    REQUIRE_MESSAGE(results, results.error().message);
    CHECK(results->points[0].metrics.notFinite == 1);
    CHECK(results->points[0].metrics.pixels == 31);
    CHECK(results->points[0].metrics.relativeRmse == doctest::Approx(0.2).epsilon(1e-5));
    const std::string summary = summaryText(*results);
    CHECK(summary.find("box front, quarter-16") != std::string::npos);
    CHECK(summary.find("1 pixel left out") != std::string::npos);
}

TEST_CASE("progress names each step and goes from 0 to 1") {
    const lab::TemporaryFolder folder;
    Chart chart;
    MadeWorkshop workshop(chart.sweep.size);
    std::vector<std::string> steps;
    double last = 0.0;
    bool rises = true;
    auto store = PointStore::open(folder.path(), chart.version, false);
    REQUIRE(store);
    const auto progress = [&](const std::string& what, double share) {
        steps.push_back(what);
        rises = rises && share >= last && share <= 1.0;
        last = share;
    };
    REQUIRE(runChart({chart.sweep, chart.views, chart.backends, chart.peers, "a machine", "half", progress},
                     workshop, *store));
    CHECK(rises);
    CHECK(steps == std::vector<std::string>{"box front: the reference", "box front, quarter-16, cpu",
                                            "box front, quarter-32, cpu", "box side: the reference",
                                            "box side, quarter-16, cpu", "box side, quarter-32, cpu"});
}

TEST_CASE("a folder is held by one run at a time") {
    const lab::TemporaryFolder folder;
    {
        const auto first = FileLock::acquire(folder.path(), FileLock::WhenTaken::fail, "taken");
        REQUIRE(first);
        const auto second = FileLock::acquire(folder.path(), FileLock::WhenTaken::fail, "taken");
        REQUIRE(!second);
        CHECK(second.error().message == "taken");
    }
    CHECK(FileLock::acquire(folder.path(), FileLock::WhenTaken::fail, "taken"));
    CHECK(!FileLock::acquire(folder / "missing" / "file", FileLock::WhenTaken::wait));
}

} // namespace
} // namespace rebound::charts
