// SPDX-License-Identifier: MIT
// The program itself: its picture, and how it refuses. Its path is in the environment variable REBOUND_VULKAN_ENGINE.
#include "../engine/program.hpp"
#include "engine_run.hpp"

namespace rebound::engine {
namespace {

constexpr const char* variable = "REBOUND_VULKAN_ENGINE";

Outcome run(const std::string& arguments, const std::filesystem::path& folder) { return runNamed(variable, arguments, folder); }

void checkRefused(const std::string& arguments, const std::string& part) {
    checkNamedRefused(variable, "rebound_vulkan_engine", arguments, part);
}

} // namespace

TEST_CASE("a picture of a built-in scene, with validation on") {
    const lab::TemporaryFolder folder;
    const Outcome outcome = run("builtin:cornell --size 120x80 --frames 3 --validation --out picture.png", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(outcome.errors.empty());
    for (const char* part : {"cornell, 120 x 80, preset quarter-64", "Rebound, in all", "written to picture.png"})
        CHECK(outcome.output.find(part) != std::string::npos);
    CHECK(lab::readText(folder / "picture.png").starts_with("\x89PNG"));
    CHECK(folder.count() == 1);
}

TEST_CASE("a window, with validation on, where there is a display") {
    const lab::TemporaryFolder folder;
    if (run("--help", folder.path()).output.find("--window") == std::string::npos || !std::getenv("DISPLAY")) {
        MESSAGE("not run: the build has no GLFW, or DISPLAY names no display");
        return;
    }
    const Outcome outcome = run("builtin:cornell --window --size 200x150 --frames 5 --validation", folder.path());
    CHECK_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(folder.count() == 0);
}

TEST_CASE("what it cannot do ends in one sentence and exit code 2") {
    checkRefused("--size 10", "--size is \"10\"; WIDTHxHEIGHT");
    checkRefused("--size 0x10", "--size is \"0x10\"");
    checkRefused("--size 10x10x10", "--size is");
    checkRefused("--size 20000x10", "--size is");
    checkRefused("--frames 0", "--frames is 0; 1 or more");
    checkRefused("--preset best", "--preset is \"best\"");
    checkRefused("--camera none builtin:cornell", "none");
    checkRefused("builtin:none", "builtin:none");
    checkRefused("missing.gltf", "missing.gltf");
    checkRefused("--no-such-option", "--no-such-option");
}

TEST_CASE("what the machine lacks ends in one sentence and exit code 2") {
    checkRefused("builtin:cornell --size 8x8 --device \"no such GPU\"", "whose name holds \"no such GPU\"");
    checkRefused("builtin:cornell --size 8x8 --out missing/folder/picture.png", "missing/folder/picture.png");
}

} // namespace rebound::engine
