// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <nlohmann/json.hpp>

namespace rebound::cli {
namespace {

TEST_CASE("explain tells causes that add up, in a table and as JSON, with a picture each") {
    const lab::TemporaryFolder folder;
    const std::string arguments = "explain builtin:cornell --size 48x36 --bounces 2 --spp 8 --preset half-64";
    const Outcome table = run(arguments, folder.path());
    REQUIRE_MESSAGE(table.exitCode == 0, table.errors);
    CHECK(folder.count() == 0);
    const Outcome outcome = run(arguments + " --json --out causes", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const auto json = nlohmann::json::parse(outcome.output);
    double part = 0.0, bias = 0.0;
    for (const auto& cause : json.at("causes")) {
        part += cause.at("part").get<double>();
        bias += cause.at("bias").get<double>();
        std::string name = cause.at("name").get<std::string>();
        CHECK(table.output.find(name) != std::string::npos);
        std::replace(name.begin(), name.end(), ' ', '_');
        CHECK(std::filesystem::file_size(folder / "causes" / (name + ".png")) > 0);
    }
    CHECK(json.at("causes").size() == 9);
    CHECK(part == doctest::Approx(json.at("whole").at("rms").get<double>()).epsilon(1e-4)); // sums of floats
    CHECK(bias == doctest::Approx(json.at("whole").at("bias").get<double>()).epsilon(1e-4));
    CHECK(std::filesystem::file_size(folder / "causes/contact_sheet.png") > 0);
    CHECK(nlohmann::json::parse(lab::readText(folder / "causes/causes.json")) == json);
}

TEST_CASE("explain refuses what it cannot do") {
    const lab::TemporaryFolder folder;
    const auto refused = [&](const std::string& arguments, std::initializer_list<std::string> texts) {
        checkRefused(run("explain builtin:cornell " + arguments, folder.path()), texts);
        CHECK(folder.count() == 0);
    };
    refused("--bounces 0", {"--bounces is 0; 1 to 64 was expected"});
    refused("--spp -4", {"--spp is -4; expected 1 to 1048576"});
    refused("--preset best", {"--preset is \"best\""});
    refused("--levels 9", {"--levels is 9"});
    refused("--frame somewhere", {"--frame"});
    refused("--only-level 1", {"--only-level"});
    refused("--out /proc/nothing/here", {"cannot write to the folder /proc/nothing"});
}

} // namespace
} // namespace rebound::cli
