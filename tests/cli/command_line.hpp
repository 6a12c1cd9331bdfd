// SPDX-License-Identifier: MIT
// Runs the command line, whose path is in the environment variable REBOUND_CLI.
#pragma once

#include "../tested_program.hpp"

namespace rebound::cli {

using test::Outcome;

inline const test::TestedProgram program{"REBOUND_CLI", "rebound"};

inline Outcome run(const std::string& arguments, const std::filesystem::path& folder,
                   const std::string& device = {}) {
    return program.run(arguments, folder, device);
}

inline void checkRefused(const Outcome& outcome, std::initializer_list<std::string> texts) {
    program.checkRefused(outcome, texts);
}

} // namespace rebound::cli
