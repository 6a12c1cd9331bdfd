// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "lab/files/command_line_error.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

namespace {

constexpr int failureExit = 2;

int fail(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::cerr << "rebound: " << message << '\n';
    return failureExit;
}

int finish(int code) {
    std::cout.flush();
    return std::cout ? code : fail("cannot write to standard output");
}

int runProgram(int argc, char** argv) {
    CLI::App program("Rebound: indirect light in real time, from what the screen shows.", "rebound");
    program.set_version_flag("--version", "rebound " REBOUND_VERSION, "print the version");
    program.set_help_flag("-h,--help", "print this help");
    program.get_formatter()->column_width(26);
    program.footer("Every command has its own help: rebound render --help\n"
                   "Exit code: 0, 1 where conform or check finds something, or 2 with one sentence on "
                   "standard error; a run that fails leaves no file behind.");
    std::vector<std::pair<CLI::App*, rebound::cli::Command>> commands;
    for (auto add :
         {rebound::cli::addRenderCommand, rebound::cli::addBenchCommand, rebound::cli::addPlanCommand,
          rebound::cli::addConformCommand, rebound::cli::addCompareCommand, rebound::cli::addExplainCommand,
          rebound::cli::addRaysCommand, rebound::cli::addChartCommand, rebound::cli::addCheckCommand,
          rebound::cli::addBakeCommand}) {
        auto command = add(program);
        commands.emplace_back(program.get_subcommands(nullptr).back(), std::move(command));
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        if (end.get_exit_code() != int(CLI::ExitCodes::Success))
            return fail(rebound::lab::sentenceOf(program, end));
        program.exit(end, std::cout, std::cerr);
        return finish(0);
    }
    for (const auto& [app, command] : commands)
        if (app->parsed()) {
            const auto done = command();
            return done ? finish(*done) : fail(done.error().message);
        }
    std::string names;
    for (const auto& command : commands) names += (names.empty() ? "" : ", ") + command.first->get_name();
    return fail("a command is missing; one of " + names + " was expected (rebound --help says more)");
}

} // namespace

int main(int argc, char** argv) {
    try {
        return runProgram(argc, argv);
    } catch (const std::bad_alloc&) {
        return fail("out of memory");
    } catch (const std::exception&) {
        return fail("something has failed that should not fail; a report with the command line would help");
    }
}
