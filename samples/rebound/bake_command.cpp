// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "frame_source.hpp"
#include "lab/baking/bake_of_scene.hpp"
#include "lab/baking/bake_pictures.hpp"
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

// The scene has to outlive its rays.
Result<Bake> bakeSource(const lab::Scene& scene, BakeSettings settings) {
    auto rays = lab::EmbreeScene::build(scene);
    if (!rays) return rays.error();
    ProgressLine line("baking");
    settings.progress = [&line](std::string_view step, double share) {
        line.describe("baking: " + std::string(step));
        line.update(share);
    };
    return lab::bakeOfScene(std::make_shared<const lab::EmbreeScene>(*std::move(rays)), settings);
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

Result<> bake(const BakeOptions& options) {
    auto settings = techniques::bakeSettingsOf(options.draft, techniques::Spelling::options);
    if (!settings) return settings.error();
    settings->threads = options.threads;
    if (options.out.empty() && options.show.empty())
        return invalidArgument("--out is missing; a file, or --show with a folder, was expected");
    const auto extent = parseSize(options.size);
    if (!extent) return extent.error();
    if (!options.show.empty())
        if (auto writable = checkOutputFolder(options.show); !writable) return writable;
    const auto view = loadView(options.source);
    if (!view) return view.error();
    const auto began = std::chrono::steady_clock::now();
    auto baked = bakeSource(view->scene, *settings);
    if (!baked) return baked.error();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    if (!options.out.empty())
        if (auto written = writeBake(*baked, options.out); !written) return written;
    if (!options.show.empty())
        if (auto shown = show(*baked, *view, *extent, options); !shown) return shown;
    const BakeLayout& layout = baked->layout;
    std::cout << options.source.scene << ": " << layout.surfels << " surfels, " << layout.gridCaches()
              << " caches in " << layout.cells << formatted(" cells of %.3g m, ", double(layout.spacing))
              << mapLine(layout) << layout.links << " links each, " << layout.bands << " bands\n"
              << sizeTable(*baked) << formatted("baked in %.1f s", took.count());
    for (const std::string& place : {options.out, options.show})
        if (!place.empty()) std::cout << ", written to " << place;
    std::cout << '\n';
    printNotes(view->scene.notes, std::cout);
    return {};
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
        "\n"
        "Examples:\n"
        "  rebound bake builtin:atrium --out atrium.bake\n"
        "  rebound bake builtin:atrium --camera nave --show baked\n"
        "  rebound bake scene.gltf --quality high --out scene.bake\n"
        "  rebound render builtin:atrium --technique composition --bake atrium.bake");
    return [options] { return exitCodeOf(bake(*options)); };
}

} // namespace rebound::cli
