// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "options.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace rebound::cli {

namespace {

Result<> printPlan(const TechniqueOptions& options) {
    const auto extent = parseSize(options.size);
    if (!extent) return extent.error();
    const auto configured = configure(options, {*extent});
    if (!configured) return configured.error();
    const Plan& plan = configured->plan;
    DeviceChoice choice;
    choice.threads = 1; // nothing runs
    const auto backend = createBackend(choice);
    if (!backend) return backend.error();
    const auto use = (*backend)->memoryUse(plan);
    if (!use) return use.error();
    std::cout << rebound::toText(plan) << "memory on the CPU " << toText(*use) << "\nmemory on a GPU "
              << toText(*memoryUse(plan)) << '\n';
    return {};
}

} // namespace

Command addPlanCommand(CLI::App& program) {
    auto options = std::make_shared<TechniqueOptions>();
    CLI::App* app = program.add_subcommand("plan", "print resources, passes and memory, and run nothing");
    addTechniqueOptions(*app, *options);
    app->footer(
        "One line a resource and a pass, as perspective cameras have them, then what they take; the GPU's\n"
        "images are counted in the formats that the plan names, without a driver's padding.\n"
        "\n"
        "Example:\n"
        "  rebound plan --size 1920x1080 --preset half-64");
    return [options] { return exitCodeOf(printPlan(*options)); };
}

} // namespace rebound::cli
