// SPDX-License-Identifier: MIT
// --technique, on every command that runs one.
#include "command_line.hpp"

#include <nlohmann/json.hpp>

namespace rebound::cli {
namespace {

TEST_CASE("every command that runs a technique takes its name") {
    const lab::TemporaryFolder folder;
    for (const char* arguments :
         {"plan --technique screen_indirect --size 64x36",
          "render builtin:cornell --technique screen_indirect --size 16x12",
          "bench builtin:cornell --technique screen_indirect --size 16x12 --frames 2 --warm-up 0",
          "explain builtin:cornell --technique screen_indirect --size 16x12 --spp 8 --bounces 1",
          "conform --technique screen_indirect --backends baseline --only black --cases 0"}) {
        CAPTURE(arguments);
        const Outcome outcome = run(arguments, folder.path());
        CHECK_MESSAGE(outcome.exitCode == 0, outcome.errors);
    }
    for (const char* command : {"plan", "render", "bench", "explain", "conform"}) {
        CAPTURE(command);
        checkRefused(run(std::string(command) + " --technique magic", folder.path()),
                     {"--technique is \"magic\"; one of screen_indirect"});
    }
    checkRefused(run("bench --technique reference", folder.path()),
                 {"--technique is \"reference\"", "screen_indirect"});
}

TEST_CASE("bench measures every combination of lists in turns, and tells ratios to the first") {
    const lab::TemporaryFolder folder;
    const Outcome outcome = run("bench builtin:cornell --size 64x36 --preset quarter-64,half-64 --smooth "
                                "on,off --frames 3 --warm-up 1 --json",
                                folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const auto runs = nlohmann::json::parse(outcome.output).at("runs");
    REQUIRE(runs.size() == 4);
    CHECK(runs[0].at("name") == "quarter-64");
    CHECK(runs[3].at("name") == "half-64 not smoothed");
    CHECK(runs[0].at("ratio") == 1.0);
    CHECK(runs[1].at("ratio").get<double>() > 0.0);
    CHECK(runs[3].at("settings").at("smooth") == false);
    CHECK(runs[0].at("technique") == "screen_indirect");
    const Outcome table = run("bench builtin:cornell --size 64x36 --samples 16,64 --frames 2", folder.path());
    CHECK(table.output.find("to the first") != std::string::npos);
    checkRefused(run("bench --samples 16,3", folder.path()), {"--samples is \"3\""});
    std::string many = "bench --samples 4";
    for (int i = 5; i < 90; ++i) many += "," + std::to_string(i);
    checkRefused(run(many, folder.path()), {"64 combinations"});
}

} // namespace
} // namespace rebound::cli
