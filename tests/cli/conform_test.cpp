// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <nlohmann/json.hpp>

namespace rebound::cli {
namespace {

TEST_CASE("conform says which backends agree, as a table and as JSON") {
    const lab::TemporaryFolder folder;
    const std::string options = "conform --backends baseline --cases 3 --only random";
    const Outcome table = run(options, folder.path());
    REQUIRE_MESSAGE(table.exitCode == 0, table.errors);
    for (const char* text : {"3 cases", "baseline", "gather", "all agree"})
        CHECK(table.output.find(text) != std::string::npos);
    const Outcome outcome = run(options + " --json --out pictures", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const auto json = nlohmann::json::parse(outcome.output);
    CHECK(json.at("agrees") == true);
    CHECK(json.at("cases") == 3);
    CHECK(json.at("passes").size() > 3);
    CHECK(json.at("disagreements").empty());
    CHECK(folder.count() == 0); // nothing disagrees, so there is no picture
}

TEST_CASE("conform compares every built-in scene at the size that it is given") {
    const lab::TemporaryFolder folder;
    const Outcome outcome =
        run("conform --backends baseline --cases 0 --only builtin: --size 33x17 --json", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const auto json = nlohmann::json::parse(outcome.output);
    // Two settings of each of two techniques, and two sizes of the Cornell box with the first of each.
    CHECK(json.at("cases") == 5 * (2 + 2) + 2 * 2);
    // 33x17 pixels take at most that many texels a case and image.
    for (const auto& pass : json.at("passes")) {
        CAPTURE(pass.dump());
        if (!pass.at("kernel").get<std::string>().starts_with("screen_indirect/"))
            continue; // others have buffers
        CHECK(pass.at("texels") <= 33 * 17 * pass.at("images").get<int>());
    }
}

TEST_CASE("conform refuses what it cannot compare") {
    const lab::TemporaryFolder folder;
    checkRefused(run("conform --backends baseline,metal", folder.path()), {"--backends", "metal"});
    checkRefused(run("conform --only nowhere", folder.path()), {"--only", "nowhere"});
    checkRefused(run("conform --size 0x5", folder.path()), {"--size", "0x5"});
    checkRefused(run("conform --cases -1", folder.path()), {"--cases"});
    checkRefused(run("conform --backends vulkan --device nothing --cases 1", folder.path()), {"Vulkan"});
}

TEST_CASE("a backend or device that is not there is one sentence") {
    const lab::TemporaryFolder folder;
    checkRefused(run("render builtin:cornell --backend metal", folder.path()), {"--backend", "metal", "cpu"});
    checkRefused(run("bench --device llvmpipe", folder.path()), {"--device", "llvmpipe"});
    checkRefused(run("bench --backend ''", folder.path()), {"--backend"});
    CHECK(folder.count() == 0);
}

} // namespace
} // namespace rebound::cli
