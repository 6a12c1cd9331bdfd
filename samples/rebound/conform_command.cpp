// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "conform_report.hpp"
#include "lab/conformance/conformance.hpp"
#include "options.hpp"
#include "progress.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace rebound::cli {

namespace {

struct ConformOptions {
    std::string backends; // comma-separated; empty: all that there are
    std::string device;
    std::string only;             // part of cases' names
    std::string technique;        // empty: all
    std::string size = "320x180"; // of scenes
    int cases = 100;
    uint64_t seed = 1;
    bool validation = false;
    bool json = false;
    std::string out;
};

// What can be held against the scalar CPU: its other instruction sets, and the GPU backends.
std::vector<std::string> contenderNames() {
    std::vector<std::string> names;
    for (const cpu::Isa isa : cpu::availableIsas())
        if (isa != cpu::Isa::scalar) names.push_back(cpu::name(isa));
    for (const std::string& name : runner::backendNames())
        if (name != "cpu") names.push_back(name);
    return names;
}

Result<conformance::Contender> createContender(const std::string& name, const ConformOptions& options) {
    runner::BackendChoice choice;
    if (const auto isa = cpu::isaFromName(name)) choice.isa = *isa;
    else choice.backend = name;
    if (choice.backend != "cpu") {
        choice.device = options.device;
        choice.validation = options.validation;
    }
    auto backend = runner::createBackend(choice);
    if (!backend) return backend.error();
    return conformance::Contender{name, *std::move(backend)};
}

struct Contenders {
    std::vector<conformance::Contender> present;
    std::vector<std::string> skipped; // and why
};

// Those that were asked for have to be there; of all others, those that are.
Result<Contenders> createContenders(const ConformOptions& options) {
    const std::vector<std::string> known = contenderNames();
    const std::vector<std::string> wanted = options.backends.empty() ? known : splitList(options.backends);
    Contenders contenders;
    for (const std::string& name : wanted) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            std::string list;
            for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
            return invalidArgument("--backends holds \"" + name + "\"; some of " + list + " were expected");
        }
        auto contender = createContender(name, options);
        if (contender) contenders.present.push_back(*std::move(contender));
        else if (options.backends.empty())
            contenders.skipped.push_back(name + ": " + contender.error().message);
        else return contender.error();
    }
    return contenders;
}

Result<std::vector<conformance::NamedCase>> chosenCases(const ConformOptions& options) {
    if (!options.technique.empty())
        if (auto known = techniques::named("--technique", options.technique); !known) return known.error();
    const auto isChosen = [&](const std::string& name) {
        return options.technique.empty() || options.technique == name;
    };
    const auto extent = parseSize(options.size);
    if (!extent) return extent.error();
    std::vector<conformance::NamedCase> all;
    const auto add = [&](std::vector<conformance::NamedCase> more) {
        all.insert(all.end(), more.begin(), more.end());
    };
    if (isChosen("screen_indirect")) {
        add(conformance::hardCases());
        add(conformance::randomCases(options.cases, options.seed));
    }
    for (const techniques::Technique& technique : techniques::all())
        if (isChosen(technique.name)) add(conformance::sceneCases({.extent = *extent}, technique));
    std::erase_if(all, [&](const auto& c) { return c.name.find(options.only) == std::string::npos; });
    return all;
}

Result<int> conform(const ConformOptions& options) {
    const auto cases = chosenCases(options);
    if (!cases) return cases.error();
    if (cases->empty())
        return invalidArgument("--only is \"" + options.only + "\", which is in no case's name");
    auto contenders = createContenders(options);
    if (!contenders) return contenders.error();
    auto report = [&] {
        ProgressLine line("comparing");
        return conformance::run(*cases, contenders->present, [&](double share) { line.update(share); });
    }();
    if (!report) return report.error();
    if (!options.out.empty())
        if (auto written = writeConformPictures(options.out, *report); !written) return written.error();
    if (options.json)
        std::cout << conformJson(*report, contenders->present, contenders->skipped).dump(2) << '\n';
    else std::cout << conformText(*report, contenders->present, contenders->skipped);
    return report->agrees() ? 0 : 1;
}

} // namespace

Command addConformCommand(CLI::App& program) {
    auto options = std::make_shared<ConformOptions>();
    CLI::App* app =
        program.add_subcommand("conform", "hold every backend against the scalar CPU, pass by pass");
    app->add_option("--backends,--backend", options->backends,
                    "some of baseline, avx2, avx512, vulkan, opengl, with commas between them\n"
                    "(default: all that this machine has)")
        ->option_text("LIST");
    app->add_option("--device", options->device, "of vulkan and opengl: part of the device's name")
        ->option_text("NAME");
    app->add_option("--technique", options->technique, "one of " + techniques::names() + " (default: all)")
        ->option_text("NAME");
    app->add_option("--cases", options->cases, "random G-buffers and settings, 0 to 100000 (default: 100)")
        ->option_text("N")
        ->check(CLI::Range(0, 100000));
    app->add_option("--seed", options->seed, "of the random cases (default: 1)")->option_text("S");
    app->add_option("--size", options->size,
                    "of the pictures of scenes [pixels], each side 1 to 16384 (default: 320x180)")
        ->option_text("WxH");
    app->add_option("--only", options->only, "only cases whose names hold this (default: all)")
        ->option_text("TEXT");
    app->add_flag("--validation", options->validation,
                  "vulkan: with validation layers, opengl: with debug output; any message is a failure");
    app->add_flag("--json", options->json, "print JSON, and nothing else, on standard output");
    app->add_option("--out", options->out,
                    "folder for pictures of what disagrees: reference, output, difference, and the\n"
                    "difference times 16 (default: none)")
        ->option_text("DIR");
    app->footer(
        "Every pass of every backend gets what the scalar CPU's passes wrote, so that a difference names "
        "its\n"
        "pass. Where reduction chooses among four texels, another choice is counted apart.\n"
        "Exit code: 0 where all agree, 1 where some do not, 2 where the comparison could not be made.\n"
        "\n"
        "Examples:\n"
        "  rebound conform\n"
        "  rebound conform --backends vulkan --device NVIDIA --cases 1000 --validation --out differences");
    return [options] { return conform(*options); };
}

} // namespace rebound::cli
