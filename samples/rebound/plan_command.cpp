// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "lab/measure/measurement.hpp"
#include "options.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <iostream>
#include <memory>

namespace rebound::cli {

namespace {

struct PlanOptions {
    TechniqueOptions technique;
    int repeats = 0; // of planning, to be timed
};

// From settings as text to the plan, on this thread alone, as an engine plans when its window changes. Precondition:
// repeats is at least 1, and planning succeeds.
std::string timePlanning(const TechniqueOptions& options, Extent2D extent, int repeats) {
    using Clock = std::chrono::steady_clock;
    measure::Series times{"planning", {}};
    for (int i = 0; i < repeats; ++i) {
        const Clock::time_point start = Clock::now();
        const auto configured = configure(options, {extent});
        times.milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    return formatted("planning takes %.3f ms, the median of %d times, from %.3f to %.3f ms\n", times.median(),
                     repeats, times.minimum(), times.percentile(100.0));
}

Result<> printPlan(const PlanOptions& options) {
    const auto extent = parseSize(options.technique.size);
    if (!extent) return extent.error();
    const auto configured = configure(options.technique, {*extent});
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
    if (options.repeats > 0) std::cout << timePlanning(options.technique, *extent, options.repeats);
    return {};
}

} // namespace

Command addPlanCommand(CLI::App& program) {
    auto options = std::make_shared<PlanOptions>();
    CLI::App* app = program.add_subcommand("plan", "print resources, passes and memory, and run nothing");
    addTechniqueOptions(*app, options->technique);
    app->add_option("--repeats", options->repeats,
                    "plan so often, 1 to 100000, and print how long planning takes (default: it is not\n"
                    "measured)")
        ->option_text("N")
        ->check(CLI::Range(1, 100000))
        ->group("Measurement");
    app->footer(
        "One line a resource and a pass, as perspective cameras have them, then what they take; the GPU's\n"
        "images are counted in the formats that the plan names, without a driver's padding.\n"
        "\n"
        "Examples:\n"
        "  rebound plan --size 1920x1080 --preset half-64\n"
        "  rebound plan --size 3840x2160 --repeats 25");
    return [options] { return exitCodeOf(printPlan(*options)); };
}

} // namespace rebound::cli
