// SPDX-License-Identifier: MIT
#include "reference_render.hpp"

#include "frame_source.hpp"
#include "lab/images/image_files.hpp"
#include "lab/light/reference_cache.hpp"
#include "lab/scenes/camera_json.hpp"
#include "lab/techniques/named_values.hpp"
#include "memory_check.hpp"
#include "output_folder.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "report.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <iostream>

namespace rebound::cli {

namespace {

namespace fs = std::filesystem;

// The paths' sums take 360, twice while they are written; the frame 52, light 136, pictures of it and files 150.
constexpr double bytesPerPixel = 1060.0;

constexpr std::pair<const char*, lab::GlossyModel> glossyNames[] = {
    {"none", lab::GlossyModel::diffuseOnly},
    {"phong", lab::GlossyModel::phong},
    {"blinn-phong", lab::GlossyModel::blinnPhong},
    {"ggx", lab::GlossyModel::ggx}};

// How the path tracer's errors name an option, and how the command line does.
constexpr std::pair<std::string_view, std::string_view> optionNames[] = {
    {"path tracer option bounces", "--bounces"},
    {"path tracer option samples", "--spp"},
    {"path tracer option error", "--error"},
    {"path tracer option threads", "--threads"}};

Error renamed(Error error) {
    for (const auto& [option, name] : optionNames)
        if (error.message.starts_with(option)) error.message.replace(0, option.size(), name);
    return error;
}

lab::Image sumOf(const lab::Image& base, const lab::Image& factor, const lab::Image& light) {
    lab::Image sum = base;
    for (size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += factor.data[i] * light.data[i];
    return sum;
}

// Radiance towards the camera, after direct light alone and after all.
RenderedImages composed(const lab::Frame& frame, const lab::PathTracedLight& light) {
    const Extent2D extent = frame.depth.extent();
    const lab::Image emission = frame.emission.empty() ? lab::Image(extent, 3) : frame.emission;
    RenderedImages images;
    images.direct = sumOf(emission, light.albedo, light.direct);
    images.indirect = light.indirect;
    images.final = sumOf(images.direct, light.albedo, light.indirect);
    if (!light.glossy.empty()) images.final = sumOf(images.final, lab::Image(extent, 3, 1.0f), light.glossy);
    return images;
}

Json describe(const SourceOptions& source, const SourcedView& view, const lab::PathTracerOptions& options,
              const lab::PathTracedLight& light, const lab::ToneCurve& curve) {
    Json json;
    json["technique"] = "reference";
    json["scene"] = source.scene;
    json["camera"] = Json::parse(lab::cameraToJson(view.camera).dump());
    json["resolution"] = {options.extent.width, options.extent.height};
    json["bounces"] = options.bounces;
    json["glossy"] = nameOf(options.glossy);
    json["seed"] = options.seed;
    json["samples"] = light.samples;
    json["relative_error"] = light.relativeError;
    json["exposure"] = curve.exposure;
    return json;
}

OutputFile exrFile(const char* name, const lab::Image& image, lab::ExrPrecision precision) {
    return {name,
            [&image, precision](const fs::path& path) { return lab::writeExr(path, image, precision); }};
}

std::vector<OutputFile> filesOf(const lab::Frame& frame, const lab::PathTracedLight& light,
                                const RenderedImages& images, const lab::ToneCurve& curve, const Json& meta) {
    std::vector<OutputFile> files;
    const auto full = lab::ExrPrecision::full;
    files.push_back(exrFile("direct.exr", light.direct, full));
    files.push_back(exrFile("first_bounce.exr", light.firstBounce, full));
    files.push_back(exrFile("indirect.exr", light.indirect, full));
    for (const auto& [name, image] : {std::pair{"first_bounce_a.exr", &light.firstBounceHalves[0]},
                                      std::pair{"first_bounce_b.exr", &light.firstBounceHalves[1]},
                                      std::pair{"indirect_a.exr", &light.indirectHalves[0]},
                                      std::pair{"indirect_b.exr", &light.indirectHalves[1]}})
        files.push_back(exrFile(name, *image, full));
    if (!light.glossy.empty()) files.push_back(exrFile("glossy.exr", light.glossy, full));
    files.push_back(exrFile("standard_error.exr", light.standardError, full));
    files.push_back(exrFile("final.exr", images.final, full));
    files.push_back(exrFile("depth.exr", frame.depth, full));
    files.push_back(exrFile("normal.exr", frame.normal, full));
    files.push_back(exrFile("albedo.exr", light.albedo, lab::ExrPrecision::half));
    if (!frame.emission.empty()) files.push_back(exrFile("emission.exr", frame.emission, full));
    const auto png = [&](const char* name, const lab::Image& image) {
        files.push_back(
            {name, [&](const fs::path& path) { return lab::writePng(path, lab::toneMap(image, curve)); }});
    };
    png("direct.png", images.direct);
    png("indirect.png", images.indirect);
    png("final.png", images.final);
    files.push_back({"contact_sheet.png", [&](const fs::path& path) {
                         return lab::writePng(path, contactSheetOf(images, frame, curve));
                     }});
    files.push_back(textFile("meta.json", toText(meta)));
    return files;
}

Result<lab::PathTracedLight> trace(const SourcedView& view, lab::PathTracerOptions options,
                                   const fs::path& out) {
    ProgressLine line("tracing paths");
    options.progress = [&line](double share) { line.update(share); };
    return lab::cachedReference(view.scene, view.camera, options, out);
}

} // namespace

const char* nameOf(lab::GlossyModel value) {
    return techniques::nameIn<lab::GlossyModel>(glossyNames, value);
}

void addReferenceOptions(CLI::App& app, ReferenceOptions& o) {
    app.add_option("--bounces", o.bounces,
                   "surfaces that light meets at most before the visible one, 0 to 64 (default: 8)")
        ->option_text("N")
        ->group(referenceGroup);
    app.add_option("--spp", o.samples, "paths a pixel at most, 1 to 1048576 (default: 256)")
        ->option_text("N")
        ->group(referenceGroup);
    app.add_option(
           "--error", o.error,
           "end earlier, once the standard error is this share of the mean, 0 to 1; 0: never\n(default: 0)")
        ->option_text("E")
        ->group(referenceGroup);
    app.add_option("--glossy", o.glossy,
                   "how surfaces shine: none, phong, blinn-phong or ggx (default: none, as the\n"
                   "techniques assume)")
        ->option_text("MODEL")
        ->group(referenceGroup);
    app.add_option("--seed", o.seed, "another one gives an independent estimate (default: 0)")
        ->option_text("N")
        ->group(referenceGroup);
}

Result<lab::PathTracerOptions> pathTracerOptionsOf(const ReferenceOptions& o, Extent2D extent, int threads) {
    lab::PathTracerOptions options;
    options.extent = extent;
    options.threads = threads;
    options.bounces = o.bounces.value_or(options.bounces);
    options.samples = o.samples.value_or(options.samples);
    options.error = o.error.value_or(options.error);
    options.seed = o.seed.value_or(options.seed);
    if (o.glossy) {
        const auto glossy = techniques::valueNamed<lab::GlossyModel>("--glossy", *o.glossy, glossyNames);
        if (!glossy) return glossy.error();
        options.glossy = *glossy;
    }
    if (auto valid = lab::validate(options); !valid) return renamed(valid.error());
    return options;
}

Result<> renderReference(const SourceOptions& source, const std::string& size, int threads,
                         const ReferenceOptions& reference, const std::string& out) {
    const auto extent = parseSize(size);
    if (!extent) return extent.error();
    const auto options = pathTracerOptionsOf(reference, *extent, threads);
    if (!options) return options.error();
    if (auto enough = checkMemory(*extent, bytesPerPixel); !enough) return enough;
    if (auto writable = checkOutputFolder(out); !writable) return writable;
    const auto view = loadView(source);
    if (!view) return view.error();
    const auto frame = lab::renderFrame(view->scene, view->camera,
                                        {.extent = *extent, .lightSamples = 1, .threads = threads});
    if (!frame) return frame.error();
    const auto light = trace(*view, *options, out);
    if (!light) return light.error();

    const RenderedImages images = composed(*frame, *light);
    const lab::ToneCurve curve = lab::automaticToneCurve(images.final);
    const Json meta = describe(source, *view, *options, *light, curve);
    const std::vector<OutputFile> files = filesOf(*frame, *light, images, curve, meta);
    if (auto written = writeOutputFolder(out, files); !written) return written;
    std::cout << source.scene << ", camera " << view->camera.name << ", " << extent->width << "x"
              << extent->height << ", path traced\n"
              << light->samples << " paths a pixel, up to " << options->bounces
              << " surfaces before the visible one, glossy " << nameOf(options->glossy)
              << formatted(", standard error %.2f %% of the mean\n", 100.0 * light->relativeError)
              << "written to " << out << ":";
    for (const OutputFile& file : files) std::cout << ' ' << file.name;
    std::cout << "\nthe same command with more paths goes on from the .paths file there\n";
    return {};
}

} // namespace rebound::cli
