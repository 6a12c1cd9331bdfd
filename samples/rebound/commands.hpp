// SPDX-License-Identifier: MIT
// The commands. Each prints to standard output only when it has succeeded.
#pragma once

#include "rebound/result.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace rebound::cli {

// The exit code of a command that has done its work.
using Command = std::function<Result<int>()>;

// Of a command that succeeds or fails.
inline Result<int> exitCodeOf(const Result<>& done) {
    if (!done) return done.error();
    return 0;
}

// Each adds a command to the program, and returns what runs it once the command line has been parsed.
Command addRenderCommand(CLI::App& program);
Command addBenchCommand(CLI::App& program);
Command addPlanCommand(CLI::App& program);
Command addConformCommand(CLI::App& program);
Command addExplainCommand(CLI::App& program);
Command addRaysCommand(CLI::App& program);
Command addCompareCommand(CLI::App& program);
Command addChartCommand(CLI::App& program);
Command addBakeCommand(CLI::App& program);
Command addCheckCommand(CLI::App& program);

} // namespace rebound::cli
