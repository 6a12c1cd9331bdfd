// SPDX-License-Identifier: MIT
#include "bake_workers.hpp"
#include "commands.hpp"
#include "frame_source.hpp"
#include "lab/baking/bake_of_scene.hpp"
#include "lab/baking/bake_pictures.hpp"
#include "lab/baking/kept_bake.hpp"
#include "lab/baking/map_places.hpp"
#include "lab/techniques/bake_settings.hpp"
#include "options.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "rebound/bake/bake_file.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

namespace rebound::cli {

namespace {

struct BakeOptions {
    SourceOptions source;
    techniques::Draft draft;
    int threads = 0;
    std::string out;
    std::string show; // a folder; empty: no pictures
    std::string size = "1280x720";
};

std::string sizeTable(const Bake& bake) {
    std::string text;
    size_t total = 0;
    for (int i = 0; i < bakeSectionCount; ++i) {
        const size_t size = sizeOf(bake.layout, BakeSection(i)) * sizeof(uint32_t);
        total += size;
        text += formatted("%-14s %10.3f MiB\n", name(BakeSection(i)), double(size) / 1048576.0);
    }
    return text + formatted("%-14s %10.3f MiB\n", "all", double(total) / 1048576.0);
}

std::string mapLine(const BakeLayout& layout) {
    if (layout.surfaceCaches == 0) return {};
    return formatted("%u in a light map of %u x %u texels of %.3g m, ", layout.surfaceCaches,
                     layout.mapSize.x, layout.mapSize.y, double(layout.mapTexel));
}

// What is known before baking begins.
struct BakeInput {
    BakeSettings settings;
    Extent2D extent;                         // of pictures
    std::shared_ptr<const SourcedView> view; // which does not move: the scene refers to it
    std::shared_ptr<const lab::EmbreeScene> scene;
};

Result<BakeInput> load(const BakeOptions& options) {
    auto settings = techniques::bakeSettingsOf(options.draft, techniques::Spelling::options);
    if (!settings) return settings.error();
    settings->threads = options.threads;
    if (options.out.empty() && options.show.empty())
        return invalidArgument("--out is missing; a file, or --show with a folder, was expected");
    const auto extent = parseSize(options.size);
    if (!extent) return extent.error();
    if (!options.show.empty())
        if (auto writable = checkOutputFolder(options.show); !writable) return writable.error();
    auto view = loadView(options.source);
    if (!view) return view.error();
    auto kept = std::make_shared<const SourcedView>(*std::move(view));
    auto rays = lab::EmbreeScene::build(kept->scene);
    if (!rays) return rays.error();
    return BakeInput{*std::move(settings), *extent, std::move(kept),
                     std::make_shared<const lab::EmbreeScene>(*std::move(rays))};
}

// Beside the file that is to be written. None where that is a device.
std::optional<BakePartFolder> partFolder(const BakeOptions& options, const BakeInput& input) {
    std::error_code ignored;
    const std::filesystem::path file(options.out);
    const auto status = std::filesystem::status(file, ignored);
    if (!file.has_filename() ||
        (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)))
        return std::nullopt;
    return BakePartFolder(options.out + ".parts", lab::bakeKey(input.view->scene, input.settings),
                          [](const std::string& sentence) { std::cerr << "rebound: " + sentence + "\n"; });
}

Result<std::optional<Bake>> bakeTogether(const BakeInput& input, BakeCrew& crew, bool isShown) {
    std::optional<ProgressLine> line;
    if (isShown) line.emplace("baking");
    BakeSettings settings = input.settings;
    settings.progress = [&line](std::string_view step, double share) {
        if (!line) return;
        line->begin("baking: " + std::string(step));
        line->update(share);
    };
    return lab::bakeOfScene(input.scene, settings, crew);
}

Result<> show(const Bake& bake, const SourcedView& view, Extent2D extent, const BakeOptions& options) {
    const auto frame = lab::renderFrame(view.scene, view.camera,
                                        {.extent = extent, .lightSamples = 1, .threads = options.threads});
    if (!frame) return frame.error();
    lab::Image mapPlaces;
    if (bake.layout.surfaceCaches > 0) {
        const auto rays = lab::EmbreeScene::build(view.scene);
        if (!rays) return rays.error();
        mapPlaces = lab::mapPlacesOf(bake, *rays, *frame, options.threads);
    }
    const std::vector<lab::NamedPicture> pictures = lab::picturesOf(bake, *frame, mapPlaces);
    std::vector<OutputFile> files;
    std::vector<lab::CaptionedPicture> captioned;
    for (const lab::NamedPicture& drawn : pictures) {
        captioned.push_back({drawn.caption, drawn.picture});
        files.push_back({drawn.name + ".png", [&drawn](const std::filesystem::path& path) {
                             return lab::writePng(path, drawn.picture);
                         }});
    }
    files.push_back({"contact_sheet.png", [&](const std::filesystem::path& path) {
                         return lab::writePng(path, lab::contactSheet(captioned, 2));
                     }});
    return writeOutputFolder(options.show, files);
}

void report(const Bake& bake, const BakeOptions& options, const std::string& how) {
    const BakeLayout& layout = bake.layout;
    std::cout << options.source.scene << ": " << layout.surfels << " surfels, " << layout.gridCaches()
              << " caches in " << layout.cells << formatted(" cells of %.3g m, ", double(layout.spacing))
              << mapLine(layout) << layout.links << " links each, " << layout.bands << " bands\n"
              << sizeTable(bake) << how;
    for (const std::string& place : {options.out, options.show})
        if (!place.empty()) std::cout << ", written to " << place;
    std::cout << '\n';
}

Result<> bake(const BakeOptions& options, BakeWorkers& workers) {
    auto input = load(options);
    if (auto ready = workers.agree(input ? Result<>() : Result<>(input.error())); !ready) return ready;
    auto kept = partFolder(options, *input);
    const auto began = std::chrono::steady_clock::now();
    auto baked = bakeTogether(*input, workers.crew(kept ? &*kept : nullptr), !workers.helpsOnly());
    if (auto done = workers.agree(baked ? Result<>() : Result<>(baked.error())); !done) return done;
    if (workers.helpsOnly()) return {};
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    const Bake& bake = **baked;
    if (!options.out.empty())
        if (auto written = writeBake(bake, options.out); !written) return written;
    if (kept) kept->remove();
    if (!options.show.empty())
        if (auto shown = show(bake, *input->view, input->extent, options); !shown) return shown;
    std::string how = formatted("baked in %.1f s", took.count());
    if (workers.processes() > 1) how += formatted(" by %d processes", workers.processes());
    if (kept && kept->partsRead() > 0)
        how += formatted(", with %zu parts that an earlier run had finished", kept->partsRead());
    report(bake, options, how);
    printNotes(input->view->scene.notes, std::cout);
    return {};
}

// Of several processes one prints what has failed.
Result<int> bake(const BakeOptions& options) {
    auto workers = bakeWorkers();
    if (!workers) return workers.error();
    const Result<> done = bake(options, **workers);
    if (done || (*workers)->processes() == 1) return exitCodeOf(done);
    // Before the workers part: mpirun ends all processes as soon as the first of them has failed.
    if (!(*workers)->helpsOnly()) std::cerr << "rebound: " + done.error().message + "\n";
    return 2;
}

} // namespace

Command addBakeCommand(CLI::App& program) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* app = program.add_subcommand(
        "bake", "compute what light paths a static scene has, for --technique composition");
    addSceneOptions(*app, options->source);
    for (const techniques::Option& option : techniques::bakeOptions())
        app->add_option_function<std::string>(
               "--" + option.name,
               [options = options.get(), name = option.name](const std::string& value) {
                   options->draft[name] = value;
               },
               option.help)
            ->option_text(option.placeholder)
            ->group("Bake");
    app->add_option("--threads", options->threads,
                    "1 to 1024; 0: one a core (default: 0). The file does not depend on it")
        ->option_text("N")
        ->check(CLI::Range(0, 1024))
        ->group(deviceGroup);
    app->add_option("--out", options->out, "the file to write")->option_text("FILE")->group("Output");
    app->add_option("--show", options->show,
                    "a folder for pictures of what was baked: surfels, patches of the tree, caches,\n"
                    "the links of the cache nearest to the picture's middle, and the light map's texels")
        ->option_text("DIR")
        ->group("Output");
    app->add_option("--size", options->size, "of these pictures [pixels] (default: 1280x720)")
        ->option_text("WxH")
        ->group("Output");
    app->footer(
        "The file holds surfels, which send light, a tree of them, caches, which receive it, and links\n"
        "between caches and the tree. It knows nothing of lights and cameras.\n"
        "What is finished is kept in FILE.parts until FILE is written: the same command goes on with it\n"
        "after an interruption, and so do the processes of mpirun, of which each does a share.\n"
        "\n"
        "Examples:\n"
        "  rebound bake builtin:atrium --out atrium.bake\n"
        "  rebound bake builtin:atrium --camera nave --show baked\n"
        "  rebound bake scene.gltf --quality high --out scene.bake\n"
        "  mpirun -n 8 rebound bake scene.gltf --quality high --out scene.bake\n"
        "  rebound render builtin:atrium --technique composition --bake atrium.bake");
    return [options] { return bake(*options); };
}

} // namespace rebound::cli
