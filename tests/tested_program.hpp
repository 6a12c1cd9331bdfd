// SPDX-License-Identifier: MIT
// A built program, run as a user does.
#pragma once

#include "lab/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <string>

namespace rebound::test {

struct Outcome {
    int exitCode = -1; // -1: it did not exit by itself
    std::string output;
    std::string errors;
};

struct TestedProgram {
    const char* variable; // of the environment, which holds its path
    std::string name;     // with which its errors begin

    // Arguments as a shell takes them; it runs within the folder, and what it prints is kept outside of it,
    // or, where a device is named, goes there.
    Outcome run(const std::string& arguments, const std::filesystem::path& folder,
                const std::string& device = {}) const {
        const char* program = std::getenv(variable);
        REQUIRE_MESSAGE(program != nullptr, variable, " has to name the program");
        const lab::TemporaryFolder printed;
        const std::string output = device.empty() ? (printed / "output").string() : device;
        const std::string command = "cd '" + folder.string() + "' && '" + program + "' " + arguments +
                                    " > '" + output + "' 2> '" + (printed / "errors").string() + "'";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, lab::readText(printed / "output"),
                lab::readText(printed / "errors")};
    }

    // Exit code 2, nothing on standard output, and one line on standard error that holds each of the texts.
    void checkRefused(const Outcome& outcome, std::initializer_list<std::string> texts) const {
        CHECK(outcome.exitCode == 2);
        CHECK(outcome.output.empty());
        CHECK(outcome.errors.starts_with(name + ": "));
        CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
        for (const std::string& text : texts) {
            INFO("it says: ", outcome.errors, " and should say: ", text);
            CHECK(outcome.errors.find(text) != std::string::npos);
        }
    }
};

} // namespace rebound::test
