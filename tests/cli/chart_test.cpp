// SPDX-License-Identifier: MIT
#include "command_line.hpp"
#include "lab/images/image_files.hpp"

#include <nlohmann/json.hpp>

namespace rebound::cli {
namespace {

namespace fs = std::filesystem;

// Two settings in one view, each some milliseconds.
constexpr const char* tinySweep = R"({
    "techniques": {"screen_indirect": [{"samples": [16, 32]}]},
    "scenes": [{"scene": "builtin:cornell", "cameras": ["front"]}],
    "size": "64x36", "frames": 3, "warm_up": 1, "reference": {"samples": 8, "error": 0.5}})";

void writeSweep(const lab::TemporaryFolder& folder) { lab::writeText(folder / "sweep.json", tinySweep); }

nlohmann::json resultsIn(const fs::path& folder) {
    return nlohmann::json::parse(lab::readText(folder / "results.json"));
}

size_t partialFiles(const fs::path& folder) {
    size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        count += entry.path().extension() == ".partial";
    return count;
}

TEST_CASE("chart writes charts, a page and results, and takes finished points up") {
    const lab::TemporaryFolder folder;
    writeSweep(folder);
    const Outcome first = run("chart --sweep sweep.json --out charts", folder.path());
    REQUIRE_MESSAGE(first.exitCode == 0, first.errors);
    for (const char* text : {"Pareto", "cornell front", "quarter-16", "one other surface", "index.html"})
        CHECK(first.output.find(text) != std::string::npos);
    for (const char* name :
         {"index.html", "results.csv", "summary.md", "chart-cornell-front.svg", "chart-cornell-front.png"})
        CHECK(fs::file_size(folder / "charts" / name) > 100);
    CHECK(!fs::exists(folder / "charts" / "chart.svg")); // one view has no mean over all
    const nlohmann::json results = resultsIn(folder / "charts");
    REQUIRE(results.at("points").size() == 2);
    const nlohmann::json& point = results["points"][0];
    CHECK(point.at("settings").at("samples_per_level") == 16);
    CHECK(point.at("time_ms").at("frames") == 3);
    CHECK(point.at("metrics").at("relative_rmse") > 0.0);
    CHECK(point.at("metrics").at("pixels") > 1000); // of 2304, all but what looks past the box
    CHECK(results.at("size") == std::vector<int>{64, 36});
    CHECK(results.at("views")[0].at("reference_samples") > 0);
    CHECK(partialFiles(folder / "charts") == 0);

    // Times are never the same to the last digit, so the same times were taken up.
    const Outcome second = run("chart --sweep sweep.json --out charts", folder.path());
    REQUIRE_MESSAGE(second.exitCode == 0, second.errors);
    CHECK(resultsIn(folder / "charts") == results);
    const Outcome fresh = run("chart --sweep sweep.json --out charts --fresh", folder.path());
    REQUIRE_MESSAGE(fresh.exitCode == 0, fresh.errors);
    CHECK(resultsIn(folder / "charts").at("points") != results.at("points"));
}

TEST_CASE("chart puts results from elsewhere beside its own") {
    const lab::TemporaryFolder folder;
    writeSweep(folder);
    fs::create_directories(folder / "peers" / "rival");
    lab::writeText(
        folder / "peers" / "rival" / "peer.json",
        R"({"format": 1, "name": "rival", "technique": "nothing at all", "scene": "builtin:cornell",
                       "camera": "front", "size": "64x36", "time_ms": {"median": 0.5}, "machine": "elsewhere"})");
    REQUIRE(lab::writeExr(folder / "peers" / "rival" / "indirect.exr", lab::Image({64, 36}, 3)));
    const Outcome outcome = run("chart --sweep sweep.json --peers peers --out charts", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const nlohmann::json points = resultsIn(folder / "charts").at("points");
    REQUIRE(points.size() == 3);
    CHECK(points[2].at("peer") == true);
    CHECK(points[2].at("machine") == "elsewhere");
    // Black where the mean is m: an error of the root of the mean square, which is at least m.
    CHECK(points[2].at("metrics").at("relative_rmse") >= 1.0);
    CHECK(points[2].at("metrics").at("mean") == 0.0);
}

TEST_CASE("chart refuses bad input in one sentence, and leaves nothing behind") {
    const lab::TemporaryFolder folder;
    writeSweep(folder);
    lab::writeText(folder / "unknown.json", R"({"techniques": {"screen_indirect": [{}]}, "sizes": "1x1"})");
    lab::writeText(folder / "impossible.json", R"({"techniques": {"screen_indirect": [{"levels": 9}]}})");
    const size_t before = folder.count();
    checkRefused(run("chart --sweep missing.json", folder.path()), {"missing.json"});
    checkRefused(run("chart --sweep unknown.json", folder.path()), {"unknown.json", "sizes", "frames"});
    checkRefused(run("chart --sweep impossible.json", folder.path()),
                 {"impossible.json", "levels is 9", "1 to 8"});
    checkRefused(run("chart --size 4", folder.path()), {"--size", "4"});
    checkRefused(run("chart --backends metal", folder.path()), {"--backends", "metal", "cpu"});
    checkRefused(run("chart --backends cpu --precision double", folder.path()), {"--precision", "double"});
    checkRefused(run("chart --threads -1", folder.path()), {"threads", "1024"});
    checkRefused(run("chart missing.gltf", folder.path()), {"missing.gltf"});
    checkRefused(run("chart ''", folder.path()), {"SCENES"});
    checkRefused(run("chart --sweep sweep.json --peers missing", folder.path()), {"missing"});
    checkRefused(run("chart --sweep sweep.json --out sweep.json", folder.path()), {"sweep.json"});
    checkRefused(run("chart --out ''", folder.path()), {"--out"});
    CHECK(folder.count() == before);
}

TEST_CASE("chart refuses results of another version, and says what to do") {
    const lab::TemporaryFolder folder;
    writeSweep(folder);
    fs::create_directories(folder / "charts" / "points");
    lab::writeText(folder / "charts" / "points" / "old.json",
                   R"({"format": 1, "version": "0.0.1", "key": {}, "point": {}})");
    checkRefused(run("chart --sweep sweep.json --out charts", folder.path()),
                 {"old.json", "0.0.1", "--fresh"});
}

TEST_CASE("without gnuplot, chart says so before it measures") {
    const lab::TemporaryFolder folder;
    writeSweep(folder);
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    const Outcome outcome = run("chart --sweep sweep.json --out charts", folder.path());
    setenv("PATH", path.c_str(), 1);
    checkRefused(outcome, {"gnuplot"});
    CHECK(!fs::exists(folder / "charts"));
}

} // namespace
} // namespace rebound::cli
