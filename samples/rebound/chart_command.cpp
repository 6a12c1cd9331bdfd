// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "lab/charts/file_lock.hpp"
#include "lab/charts/gnuplot.hpp"
#include "lab/charts/report.hpp"
#include "lab/charts/run.hpp"
#include "lab/files/output_file.hpp"
#include "lab/scenes/scene_files.hpp"
#include "memory_check.hpp"
#include "options.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <span>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

struct ChartOptions {
    std::vector<std::string> scenes;
    std::string sweep;    // a file; empty: the default
    std::string size;     // empty: the sweep's
    std::string backends; // with commas; empty: the sweep's
    std::string device;
    int threads = 0;
    std::string precision = "half";
    std::string peers;
    std::string references; // empty: within the output folder
    std::string out = "chart";
    bool fresh = false;
};

// The sweep file's choices, or those of the command line.
Result<charts::Sweep> sweepOf(const ChartOptions& options) {
    std::optional<Extent2D> size;
    if (!options.size.empty()) {
        const auto parsed = parseSize(options.size);
        if (!parsed) return parsed.error();
        size = *parsed;
    }
    auto sweep = options.sweep.empty()
                     ? charts::parseSweep(charts::defaultSweepText(), "the default sweep", size)
                     : charts::readSweep(options.sweep, size);
    if (!sweep) return sweep;
    if (!options.backends.empty()) sweep->backends = splitList(options.backends);
    if (options.scenes.empty()) return sweep;
    sweep->scenes.clear();
    for (const std::string& scene : options.scenes) {
        if (scene.empty())
            return invalidArgument("SCENES holds an empty name; glTF files, " + lab::builtinSceneList() +
                                   " were expected");
        sweep->scenes.push_back({scene, "", {}});
    }
    return sweep;
}

Result<> checkMemoryOf(const std::vector<charts::ChartBackend>& backends, const charts::Sweep& sweep) {
    for (const charts::ChartBackend& backend : backends)
        for (const charts::Setting& setting : sweep.settings) {
            if (auto enough = checkMemory(*backend.backend, setting.configured.plan, sweep.size); !enough)
                return enough;
        }
    return {};
}

// A folder for files that other programs write, gone at the end.
class ScratchFolder {
public:
    ScratchFolder() : path_((fs::temp_directory_path() / "rebound-chart-XXXXXX").string()) {
        made = mkdtemp(path_.data()) != nullptr;
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        if (made) fs::remove_all(path_, ignored);
    }
    bool exists() const { return made; }
    fs::path path() const { return path_; }

private:
    std::string path_;
    bool made = false;
};

OutputFile copyOf(const fs::path& file) {
    return {file.filename().string(), [file](const fs::path& path) -> Result<> {
                std::error_code failure;
                fs::copy_file(file, path, failure);
                if (failure)
                    return Error{ErrorCode::inputOutput,
                                 "cannot write " + path.string() + ": " + failure.message()};
                return {};
            }};
}

charts::PlotTexts plotTexts(const charts::Results& results) {
    charts::PlotTexts texts;
    texts.subtitle = std::to_string(results.size.width) + "x" + std::to_string(results.size.height) +
                     ", Rebound " + results.version + " on " + results.machine;
    texts.xLabel = "median time of a frame [ms]; bars: 10th to 90th percentile";
    texts.yLabel =
        "relative RMSE against " +
        (results.bounces == 1 ? std::string("one bounce") : std::to_string(results.bounces) + " bounces") +
        ", path traced";
    return texts;
}

Result<std::vector<OutputFile>> drawings(const charts::Results& results, const fs::path& gnuplot,
                                         const ScratchFolder& scratch) {
    if (!scratch.exists())
        return Error{ErrorCode::inputOutput, "cannot create the folder " + scratch.path().string()};
    const std::vector<charts::Chart> all = charts::chartsOf(results);
    const std::string commands = charts::plotScript(all, plotTexts(results), scratch.path());
    const fs::path script = scratch.path() / "charts.gnuplot";
    if (auto written = lab::writeFile(script, std::as_bytes(std::span(commands))); !written)
        return written.error();
    if (auto drawn = charts::runGnuplot(gnuplot, script); !drawn) return drawn.error();
    std::vector<OutputFile> files;
    for (const charts::Chart& chart : all)
        if (!chart.points.empty())
            for (const char* end : {".svg", ".png"})
                files.push_back(copyOf(scratch.path() / (chart.fileName + end)));
    return files;
}

Result<> writeResults(const charts::Results& results, const fs::path& out, const fs::path& gnuplot) {
    const ScratchFolder scratch;
    auto files = drawings(results, gnuplot, scratch);
    if (!files) return files.error();
    auto page = charts::resultsPage(results, out / "pictures");
    if (!page) return page.error();
    files->push_back(textFile("index.html", *std::move(page)));
    files->push_back(textFile("results.csv", charts::resultsCsv(results)));
    files->push_back(textFile("results.json", toText(charts::toJson(results))));
    files->push_back(textFile("summary.md", charts::summaryText(results)));
    return writeOutputFolder(out, *files);
}

// Everything that can be refused before anything is measured.
struct Prepared {
    charts::Sweep sweep;
    fs::path gnuplot;
    std::vector<charts::ChartBackend> backends;
    std::vector<charts::View> views;
    std::vector<charts::Peer> peers;
    runner::Precision precision = runner::Precision::half;
};

Result<Prepared> prepareChart(const ChartOptions& options) {
    Prepared prepared;
    auto sweep = sweepOf(options);
    if (!sweep) return sweep.error();
    prepared.sweep = *std::move(sweep);
    const auto precision = measure::precisionNamed("--precision", options.precision);
    if (!precision) return precision.error();
    prepared.precision = *precision;
    const std::string what = options.backends.empty() ? "backends of the sweep" : "--backends";
    auto backends = charts::createBackends(what, prepared.sweep.backends, options.device, options.threads);
    if (!backends) return backends.error();
    prepared.backends = *std::move(backends);
    if (auto enough = checkMemoryOf(prepared.backends, prepared.sweep); !enough) return enough.error();
    auto gnuplot = charts::findGnuplot();
    if (!gnuplot) return gnuplot.error();
    prepared.gnuplot = *std::move(gnuplot);
    auto views = charts::loadViews(prepared.sweep);
    if (!views) return views.error();
    prepared.views = *std::move(views);
    if (!options.peers.empty()) {
        auto peers = charts::readPeers(options.peers, prepared.views, prepared.sweep.size);
        if (!peers) return peers.error();
        prepared.peers = *std::move(peers);
    }
    return prepared;
}

Result<> chart(const ChartOptions& options) {
    if (auto writable = checkOutputFolder(options.out); !writable) return writable;
    auto prepared = prepareChart(options);
    if (!prepared) return prepared.error();
    const fs::path out = options.out;
    std::error_code failure;
    fs::create_directories(out, failure); // what it reports, the lock meets too
    const auto lock = charts::FileLock::acquire(out, charts::FileLock::WhenTaken::fail,
                                                "another run is writing to " + out.string());
    if (!lock) return lock.error();
    auto store = charts::PointStore::open(out, REBOUND_VERSION, options.fresh);
    if (!store) return store.error();
    const fs::path references =
        options.references.empty() ? out / "references" : fs::path(options.references);
    charts::LabWorkshop workshop(prepared->sweep, prepared->precision, references);
    const auto results = [&] {
        ProgressLine line("charting");
        return charts::runChart({prepared->sweep, prepared->views, prepared->backends, prepared->peers,
                                 charts::describeMachine(), options.precision,
                                 [&line](const std::string& what, double share) {
                                     line.describe(what);
                                     line.update(share);
                                 }},
                                workshop, *store);
    }();
    if (!results) return results.error();
    if (auto written = writeResults(*results, out, prepared->gnuplot); !written) return written;
    std::cout << charts::summaryText(*results) << "\nwritten to " << out.string()
              << ": index.html, results.json, results.csv, summary.md, chart*.svg, chart*.png\n";
    return {};
}

} // namespace

Command addChartCommand(CLI::App& program) {
    auto options = std::make_shared<ChartOptions>();
    CLI::App* app = program.add_subcommand("chart", "chart speed against accuracy");
    app->add_option("scenes", options->scenes,
                    "glTF 2.0 files, or some of " + lab::builtinSceneList() +
                        ";\nall their cameras (default: the sweep's)")
        ->option_text("SCENES...");
    app->add_option("--sweep", options->sweep,
                    "a JSON file: settings, backends, scenes, size, frames, reference\n"
                    "(default: all presets, 16 to 256 samples, both starts and reductions)")
        ->option_text("FILE");
    app->add_option("--size", options->size, "of the pictures [pixels] (default: the sweep's, or 640x360)")
        ->option_text("WxH");
    app->add_option("--backends,--backend", options->backends,
                    "some of cpu, vulkan, opengl and the CPU's instruction sets, with commas\n"
                    "between them (default: the sweep's, or cpu)")
        ->option_text("LIST");
    app->add_option("--device", options->device, "of vulkan and opengl: part of the device's name")
        ->option_text("NAME");
    app->add_option("--threads", options->threads, "of the CPU, 1 to 1024; 0: one a core (default: 0)")
        ->option_text("N");
    app->add_option("--precision", options->precision,
                    "how the host keeps colours and normals: half or float (default: half)")
        ->option_text("P");
    app->add_option("--peers", options->peers, "a folder of results from elsewhere, which become points too")
        ->option_text("DIR");
    app->add_option("--references", options->references,
                    "folder where path-traced references are kept, for other charts too\n"
                    "(default: references in the output folder)")
        ->option_text("DIR");
    app->add_option("--out", options->out,
                    "folder for the outputs, created where it is missing (default: chart)")
        ->option_text("DIR");
    app->add_flag("--fresh", options->fresh, "forget the finished points of the output folder");
    app->footer(
        "Each setting is run on each backend in each view, one after the other, and its light is held\n"
        "against path-traced light. Outputs: index.html, a page that needs nothing else; chart*.svg and\n"
        "chart*.png; results.json and results.csv; summary.md; points/ and pictures/.\n"
        "Finished points stay when a run is interrupted, and the next one goes on from there.\n"
        "\n"
        "Examples:\n"
        "  rebound chart\n"
        "  rebound chart scene.gltf --size 1280x720 --backends cpu,vulkan --out hall\n"
        "  rebound chart --sweep sweep.json --peers rivals --out compared");
    return [options] { return exitCodeOf(chart(*options)); };
}

} // namespace rebound::cli
