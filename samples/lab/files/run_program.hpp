// SPDX-License-Identifier: MIT
// Other programs, found in PATH and run to their end.
#pragma once

#include "rebound/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rebound::lab {

// The path of the program of that name, looked for in PATH.
std::optional<std::filesystem::path> findProgram(const std::string& name);

// Runs a program without input and drops what it writes. Where it fails, the error's message is the last line that it
// complained with; `marks`: characters of which alone no such line consists.
Result<> runProgram(const std::filesystem::path&, const std::vector<std::string>& arguments,
                    const std::string& marks = " \t");

} // namespace rebound::lab
