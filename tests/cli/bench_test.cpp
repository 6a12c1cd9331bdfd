// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace rebound::cli {
namespace {

TEST_CASE("bench --json prints JSON alone, with every gather pass") {
    const lab::TemporaryFolder folder;
    const Outcome outcome =
        run("bench builtin:cornell --size 64x48 --frames 4 --warm-up 1 --threads 2 --isa scalar --json",
            folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const auto json = nlohmann::json::parse(outcome.output);
    int gathers = 0;
    double minima = 0.0;
    for (const auto& pass : json.at("passes")) {
        CHECK(pass.at("minimum_ms").get<double>() <= pass.at("median_ms").get<double>());
        gathers += pass.at("name").get<std::string>().find("gather") != std::string::npos;
        minima += pass.at("minimum_ms").get<double>();
    }
    CHECK(gathers == 4);
    CHECK(minima > 0.0);
    // No frame is faster than its passes at their fastest.
    CHECK(minima <= json.at("frame").at("minimum_ms").get<double>());
    CHECK(json.at("frame").at("minimum_ms") <= json.at("frame").at("median_ms"));
    CHECK(json.at("resolution") == nlohmann::json::array({64, 48}));
    CHECK(json.at("isa") == "scalar");
    CHECK(json.at("threads") == 2);
    CHECK(json.at("settings").at("start") == "quarter");
    CHECK(json.at("memory").at("total_bytes").get<size_t>() > 0);
    CHECK(folder.count() == 0);
}

TEST_CASE("bench prints a table with every pass") {
    const lab::TemporaryFolder folder;
    const Outcome outcome = run("bench builtin:cornell --size 32x32 --levels 2 --frames 2", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    for (const char* text : {"median", "minimum", "gather level 0", "gather level 1", "frame", "memory"})
        CHECK_MESSAGE(outcome.output.find(text) != std::string::npos, text);
    CHECK(outcome.output.find("gather level 2") == std::string::npos);
}

TEST_CASE("plan prints passes and memory for the size and settings it is given") {
    const lab::TemporaryFolder folder;
    const Outcome outcome = run("plan --size 640x360 --start half --levels 3", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    for (const char* text : {"input 640x360", "pass gather level 2", "320x180", "memory"})
        CHECK_MESSAGE(outcome.output.find(text) != std::string::npos, text);
    CHECK(outcome.output.find("gather level 3") == std::string::npos);
    CHECK(outcome.output.find("pass smooth") != std::string::npos);
    CHECK(run("plan --smooth off", folder.path()).output.find("pass smooth") == std::string::npos);
}

TEST_CASE("plan --repeats prints how long planning takes, and nothing else changes") {
    const lab::TemporaryFolder folder;
    const std::string plan = run("plan --size 640x360", folder.path()).output;
    CHECK(plan.find("planning takes") == std::string::npos);
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run("plan --size 640x360 --repeats 7", folder.path());
    const std::chrono::duration<double, std::milli> whole = std::chrono::steady_clock::now() - start;
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    REQUIRE(outcome.output.starts_with(plan));
    double median = 0, least = 0, most = 0;
    int repeats = 0;
    REQUIRE(std::sscanf(outcome.output.c_str() + plan.size(),
                        "planning takes %lf ms, the median of %d times, from %lf to %lf ms\n", &median,
                        &repeats, &least, &most) == 4);
    CHECK(repeats == 7);
    CHECK(least > 0.0);
    CHECK(least <= median);
    CHECK(median <= most);
    CHECK(4 * median <= whole.count()); // four of seven take at least the median
    checkRefused(run("plan --repeats 0", folder.path()), {"--repeats", "0"});
}

TEST_CASE("help and version are answers, not failures") {
    const lab::TemporaryFolder folder;
    for (const char* arguments : {"--help", "render --help", "bench --help", "plan --help", "--version"}) {
        const Outcome outcome = run(arguments, folder.path());
        CHECK(outcome.exitCode == 0);
        CHECK(outcome.output.size() > 10);
        CHECK(outcome.errors.empty());
    }
    CHECK(run("render --help", folder.path()).output.find("--only-level") != std::string::npos);
}

} // namespace
} // namespace rebound::cli
