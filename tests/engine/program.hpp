// SPDX-License-Identifier: MIT
// What the engines' programs do alike.
#pragma once

#include "../tested_program.hpp"

namespace rebound::engine {

using test::TestedProgram;

// A picture of a built-in scene, without a word from the API's validation or debug output.
inline void checkPicture(const TestedProgram& program) {
    const lab::TemporaryFolder folder;
    const test::Outcome outcome =
        program.run("builtin:cornell --size 120x80 --frames 3 --validation --out picture.png", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(outcome.errors.empty());
    for (const char* part :
         {"cornell, 120 x 80, preset quarter-64", "Rebound, in all", "written to picture.png"})
        CHECK(outcome.output.find(part) != std::string::npos);
    CHECK(lab::readText(folder / "picture.png").starts_with("\x89PNG"));
    CHECK(folder.count() == 1);
}

inline void checkWindow(const TestedProgram& program) {
    const lab::TemporaryFolder folder;
    if (program.run("--help", folder.path()).output.find("--window") == std::string::npos ||
        !std::getenv("DISPLAY")) {
        MESSAGE("not run: the build has no GLFW, or DISPLAY names no display");
        return;
    }
    const test::Outcome outcome =
        program.run("builtin:cornell --window --size 200x150 --frames 5 --validation", folder.path());
    CHECK_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(folder.count() == 0);
}

// Refused in one sentence with exit code 2, and no file.
inline void checkRefused(const TestedProgram& program, const std::string& arguments,
                         const std::string& part) {
    const lab::TemporaryFolder folder;
    INFO(arguments);
    program.checkRefused(program.run(arguments, folder.path()), {part});
    CHECK(folder.count() == 0);
}

inline void checkRefusals(const TestedProgram& program) {
    checkRefused(program, "--size 10", "--size is \"10\"; WIDTHxHEIGHT");
    checkRefused(program, "--size 0x10", "--size is \"0x10\"");
    checkRefused(program, "--size 10x10x10", "--size is");
    checkRefused(program, "--size 20000x10", "--size is");
    checkRefused(program, "--frames 0", "--frames is 0; 1 or more");
    checkRefused(program, "--preset best", "--preset is \"best\"");
    checkRefused(program, "--camera none builtin:cornell", "none");
    checkRefused(program, "builtin:none", "builtin:none");
    checkRefused(program, "missing.gltf", "missing.gltf");
    checkRefused(program, "--no-such-option", "--no-such-option");
    checkRefused(program, "builtin:cornell --size 8x8 --device \"no such GPU\"",
                 "whose name holds \"no such GPU\"");
    checkRefused(program, "builtin:cornell --size 8x8 --out missing/folder/picture.png",
                 "missing/folder/picture.png");
}

} // namespace rebound::engine
