// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "frame_source.hpp"
#include "lab/examine/frame_examination.hpp"
#include "lab/rays/frame_check.hpp"
#include "options.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

namespace rebound::cli {

namespace {

constexpr int mistakesExit = 1;

struct CheckOptions {
    SourceOptions source;
    std::string size = "640x360";
    int threads = 0;
    bool json = false;
};

struct Examination {
    SourcedFrame source;
    std::optional<std::string> wrongPixels; // what lab::checkFrame refuses
    std::vector<InputFinding> findings;

    bool hasMistakes() const {
        return wrongPixels || std::any_of(findings.begin(), findings.end(), [](const InputFinding& f) {
                   return f.certainty == Certainty::mistake;
               });
    }
};

const char* nameOf(Certainty certainty) { return certainty == Certainty::mistake ? "mistake" : "suspicion"; }

Result<Examination> examine(const CheckOptions& options) {
    SourceOptions from = options.source;
    std::error_code ignored;
    if (std::filesystem::is_directory(from.scene, ignored)) {
        if (from.animation || from.time)
            return invalidArgument("--animation and --time need a scene, but " + from.scene + " is a folder");
        std::swap(from.frame, from.scene);
    }
    const auto extent = parseSize(options.size);
    if (!extent) return extent.error();
    auto source = obtainFrame(from, *extent, options.threads, WrongPixels::keep);
    if (!source) return source.error();
    Examination examination{*std::move(source), {}, {}};
    if (auto sound = checkPixels(examination.source); !sound) examination.wrongPixels = sound.error().message;
    auto findings = examine::examineFrame(examination.source.frame, options.threads);
    if (!findings) return findings.error();
    examination.findings = *std::move(findings);
    return examination;
}

Json toJson(const Examination& examination) {
    Json json;
    const SourcedFrame& source = examination.source;
    json[source.isStored ? "frame_folder" : "scene"] = source.name;
    json["camera"] = source.frame.camera.name;
    json["resolution"] = {source.frame.depth.width, source.frame.depth.height};
    json["notes"] = source.notes;
    json["findings"] = Json::array();
    if (examination.wrongPixels)
        json["findings"].push_back({{"problem", "pixels"},
                                    {"certainty", nameOf(Certainty::mistake)},
                                    {"measure", nullptr},
                                    {"sentence", *examination.wrongPixels}});
    for (const InputFinding& finding : examination.findings)
        json["findings"].push_back({{"problem", name(finding.problem)},
                                    {"certainty", nameOf(finding.certainty)},
                                    {"measure", finding.measure},
                                    {"sentence", finding.sentence}});
    return json;
}

void print(const Examination& examination) {
    const SourcedFrame& source = examination.source;
    std::cout << source.name;
    if (!source.frame.camera.name.empty()) std::cout << ", camera " << source.frame.camera.name;
    std::cout << ", " << source.frame.depth.width << "x" << source.frame.depth.height << '\n';
    printNotes(source.notes, std::cout);
    if (examination.wrongPixels) std::cout << "mistake: " << *examination.wrongPixels << '\n';
    for (const InputFinding& finding : examination.findings)
        std::cout << nameOf(finding.certainty) << ": " << finding.sentence << '\n';
    if (!examination.wrongPixels && examination.findings.empty())
        std::cout << "depth, normals, albedo, light and camera fit together\n";
}

Result<int> check(const CheckOptions& options) {
    const auto examination = examine(options);
    if (!examination) return examination.error();
    if (options.json) std::cout << toText(toJson(*examination));
    else print(*examination);
    return examination->hasMistakes() ? mistakesExit : 0;
}

} // namespace

Command addCheckCommand(CLI::App& program) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* app =
        program.add_subcommand("check", "say what does not fit together in a G-buffer, or in a scene's");
    addSceneOptions(*app, options->source);
    app->get_option("scene")
        ->description("a folder as render --frame takes it; or a glTF 2.0 file (.gltf, .glb), or\n"
                      "a built-in scene (default: builtin:atrium)")
        ->option_text("DIR | SCENE");
    app->add_option("--size", options->size, "of a scene's pictures [pixels] (default: 640x360)")
        ->option_text("WxH")
        ->group(sourceGroup);
    app->add_option("--threads", options->threads, "1 to 1024; 0: one a core (default: 0)")
        ->option_text("N")
        ->check(CLI::Range(0, 1024))
        ->group(deviceGroup);
    app->add_flag("--json", options->json, "print JSON, and nothing else, on standard output")
        ->group("Output");
    app->footer("Prints a line for each thing:\n"
                "  note       what was converted, taken for something else or left out of the files\n"
                "  suspicion  what may be right; the sentence says when\n"
                "  mistake    what is wrong in any frame\n"
                "Exit code: 1 with a mistake, else 0; 2 where the files cannot be read.\n"
                "\n"
                "Examples:\n"
                "  rebound check captured\n"
                "  rebound check captured --view view.json --camera front --json\n"
                "  rebound check scene.gltf");
    return [options] { return check(*options); };
}

} // namespace rebound::cli
