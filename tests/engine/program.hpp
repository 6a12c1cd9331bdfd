// SPDX-License-Identifier: MIT
// The engines' programs, run as a user does.
#pragma once

#include "../lab/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace rebound::engine {

struct Outcome {
    int exitCode = -1;
    std::string output, errors;
};

// The program whose path is in that environment variable.
inline Outcome runNamed(const char* variable, const std::string& arguments, const std::filesystem::path& folder) {
    const char* program = std::getenv(variable);
    REQUIRE_MESSAGE(program != nullptr, variable, " has to name the program");
    const lab::TemporaryFolder printed;
    const std::string command = "cd '" + folder.string() + "' && '" + program + "' " + arguments + " > '" +
                                (printed / "output").string() + "' 2> '" + (printed / "errors").string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, lab::readText(printed / "output"),
            lab::readText(printed / "errors")};
}

// One sentence that begins with the program's name and holds that part, exit code 2, no file.
inline void checkNamedRefused(const char* variable, const std::string& name, const std::string& arguments,
                              const std::string& part) {
    const lab::TemporaryFolder folder;
    const Outcome outcome = runNamed(variable, arguments, folder.path());
    INFO(arguments, ": ", outcome.errors);
    CHECK(outcome.exitCode == 2);
    CHECK(outcome.output.empty());
    CHECK(outcome.errors.starts_with(name + ": "));
    CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
    CHECK(outcome.errors.find(part) != std::string::npos);
    CHECK(folder.count() == 0);
}

} // namespace rebound::engine
