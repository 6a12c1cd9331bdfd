// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "compare_report.hpp"
#include "lab/images/image_files.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rebound::cli {

namespace {

struct CompareCommandOptions {
    std::string test, truth;
    std::optional<std::string> otherHalf; // then the truth is the mean of both
    std::optional<std::string> mask, surfaces, out;
    std::optional<double> exposure, largest, truthNoise;
    double pixelsPerDegree = metrics::CompareOptions().pixelsPerDegree;
    bool json = false;
};

Result<> checkNumber(const char* option, std::optional<double> value, double least, double most,
                     const char* expected) {
    if (!value || (*value >= least && *value <= most)) return {};
    return invalidArgument(formatted("%s is %g; %s was expected", option, *value, expected));
}

Result<> checkOptions(const CompareCommandOptions& options) {
    // Smaller and larger factors make every picture black or white.
    if (auto valid = checkNumber("--exposure", options.exposure, 1e-30, 1e30, "a factor from 1e-30 to 1e30");
        !valid)
        return valid;
    if (auto valid = checkNumber("--pixels-per-degree", options.pixelsPerDegree, 1.0, 1000.0, "1 to 1000");
        !valid)
        return valid;
    if (auto valid = checkNumber("--largest", options.largest, std::numeric_limits<float>::min(),
                                 std::numeric_limits<float>::max(), "a difference above 0");
        !valid)
        return valid;
    if (auto valid =
            checkNumber("--truth-noise", options.truthNoise, 0.0, 10.0, "a share of the mean, 0 to 10,");
        !valid)
        return valid;
    if (options.truthNoise && options.otherHalf)
        return invalidArgument("--truth-noise is given with two halves of the truth, which tell its noise");
    if (options.mask && options.mask->empty()) return invalidArgument("--mask is empty; a file was expected");
    if (options.surfaces && options.surfaces->empty())
        return invalidArgument("--surfaces is empty; a folder was expected");
    if (options.out && !options.out->ends_with(".png"))
        return invalidArgument("--out is \"" + *options.out +
                               "\"; a file whose name ends in .png was expected");
    return {};
}

lab::Image withoutAlpha(const lab::Image& image) {
    if (image.channels != 4) return image;
    lab::Image colors(image.extent(), 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) std::copy_n(image.at(x, y), 3, colors.at(x, y));
    return colors;
}

struct Pictures {
    lab::Image test, truth;
    std::optional<std::array<lab::Image, 2>> halves;
    std::optional<lab::Image> mask;
    lab::Image depth, normal; // empty without surfaces
    std::vector<std::string> notes;
};

// What lies in no data window is no number, and so left out and counted.
Result<lab::Image> readPicture(const std::string& file, std::vector<std::string>& notes) {
    auto image = lab::readExr(file, {lab::ExrContent::any, std::numeric_limits<float>::quiet_NaN(), &notes});
    if (!image) return image;
    return withoutAlpha(*image);
}

// Turns the truth into the mean of both halves. Where they do not fit, the truth is the first, and comparing says so.
void takeHalves(Pictures& pictures, lab::Image other) {
    lab::Image first = pictures.truth;
    if (first.data.size() == other.data.size())
        for (size_t i = 0; i < first.data.size(); ++i)
            pictures.truth.data[i] = 0.5f * (first.data[i] + other.data[i]);
    pictures.halves = {std::move(first), std::move(other)};
}

// Of a frame folder; what lies in no data window is no surface.
Result<> readSurfaces(const std::filesystem::path& folder, Pictures& pictures) {
    auto depth = lab::readExr(folder / "depth.exr", {lab::ExrContent::depth, 0.0f, &pictures.notes});
    if (!depth) return depth.error();
    auto normal = lab::readExr(folder / "normal.exr", {lab::ExrContent::normal, 0.0f, &pictures.notes});
    if (!normal) return normal.error();
    pictures.depth = *std::move(depth);
    pictures.normal = withoutAlpha(*normal);
    return {};
}

Result<Pictures> readPictures(const CompareCommandOptions& options) {
    Pictures pictures;
    auto test = readPicture(options.test, pictures.notes);
    if (!test) return test.error();
    auto truth = readPicture(options.truth, pictures.notes);
    if (!truth) return truth.error();
    pictures.test = *std::move(test);
    pictures.truth = *std::move(truth);
    if (options.otherHalf) {
        auto other = readPicture(*options.otherHalf, pictures.notes);
        if (!other) return other.error();
        takeHalves(pictures, *std::move(other));
    }
    if (options.mask) {
        auto mask = lab::readExr(*options.mask, {lab::ExrContent::any, 0.0f, &pictures.notes});
        if (!mask) return mask.error();
        pictures.mask = *std::move(mask);
    }
    if (options.surfaces)
        if (auto read = readSurfaces(*options.surfaces, pictures); !read) return read.error();
    return pictures;
}

// The library knows roles; the files' names are in front of what it says.
Error named(const CompareCommandOptions& options, const Error& error) {
    std::string files = options.test + " against " + options.truth;
    if (options.otherHalf) files += " and " + *options.otherHalf;
    if (options.mask) files += " with mask " + *options.mask;
    if (options.surfaces) files += " on surfaces of " + *options.surfaces;
    return {error.code, files + ": " + error.message};
}

Result<> compare(const CompareCommandOptions& options) {
    if (auto valid = checkOptions(options); !valid) return valid;
    const auto pictures = readPictures(options);
    if (!pictures) return pictures.error();
    metrics::CompareOptions how;
    how.mask = pictures->mask ? &*pictures->mask : nullptr;
    how.curve = options.exposure ? lab::ToneCurve{float(*options.exposure)}
                                 : lab::automaticToneCurve(pictures->truth);
    how.pixelsPerDegree = options.pixelsPerDegree;
    how.truthNoise = options.truthNoise;
    if (pictures->halves) how.halves = metrics::TruthHalves{&(*pictures->halves)[0], &(*pictures->halves)[1]};
    if (options.surfaces) how.surfaces = metrics::Surfaces{&pictures->depth, &pictures->normal};
    const auto found = metrics::compareImages(pictures->test, pictures->truth, how);
    if (!found) return named(options, found.error());
    if (options.out) {
        const auto picture = metrics::errorPicture(pictures->test, pictures->truth, how, options.largest);
        if (!picture) return named(options, picture.error());
        if (auto written = lab::writePng(*options.out, *picture); !written) return written;
    }
    const Comparison comparison{options.test,
                                options.truth,
                                options.otherHalf,
                                options.mask,
                                options.surfaces,
                                pictures->truth.extent(),
                                pictures->truth.channels,
                                *how.curve,
                                how.pixelsPerDegree,
                                *found};
    if (options.json) std::cout << toText(compareJson(comparison));
    else std::cout << compareText(comparison);
    for (const std::string& note : pictures->notes)
        (options.json ? std::cerr : std::cout) << "note: " << note << '\n';
    return {};
}

} // namespace

Command addCompareCommand(CLI::App& program) {
    auto options = std::make_shared<CompareCommandOptions>();
    CLI::App* app = program.add_subcommand("compare", "measure how far a picture is from the truth");
    app->add_option("TEST", options->test, "the picture under test, an OpenEXR file in linear radiance")
        ->option_text("FILE")
        ->required();
    app->add_option("TRUTH", options->truth, "what it should be, of the same size and channels")
        ->option_text("FILE")
        ->required();
    app->add_option("TRUTH_B", options->otherHalf,
                    "where it is given, TRUTH and this are independent halves of the truth, whose\n"
                    "noise is taken out of RMSE")
        ->option_text("FILE");
    app->add_option("--truth-noise", options->truthNoise,
                    "of a truth without halves: the standard deviation of its noise, as a share of\n"
                    "its mean; its square is taken off the squared RMSE")
        ->option_text("SHARE");
    app->add_option("--mask", options->mask,
                    "an OpenEXR file of one channel; only pixels where it is above 0 count\n"
                    "(default: all)")
        ->option_text("FILE");
    app->add_option("--surfaces", options->surfaces,
                    "a folder with depth.exr and normal.exr of the view: measures how much pattern\n"
                    "the difference has on smooth surfaces (default: it is not measured)")
        ->option_text("DIR");
    app->add_option("--exposure", options->exposure,
                    "of both pictures for SSIM and FLIP, a factor on radiance (default: maps\n"
                    "the 90th percentile of the truth's luminance to 0.8)")
        ->option_text("E");
    app->add_option("--pixels-per-degree", options->pixelsPerDegree,
                    "of FLIP's observer, 1 to 1000 (default: 67, a 0.7 m wide monitor of 3840\n"
                    "pixels from 0.7 m)")
        ->option_text("P");
    app->add_option("--largest", options->largest,
                    "the difference that takes the brightest colour of the picture of errors\n"
                    "(default: the 99th percentile, rounded up)")
        ->option_text("V");
    app->add_option("--out", options->out, "a PNG file for a picture of the errors (default: none)")
        ->option_text("FILE");
    app->add_flag("--json", options->json, "print JSON, and nothing else, on standard output");
    app->footer(
        "Pixels that are not finite in either picture are counted and left out.\n"
        "\n"
        "Examples:\n"
        "  rebound compare out/indirect.exr truth.exr\n"
        "  rebound compare out/indirect.exr truth/first_bounce_a.exr truth/first_bounce_b.exr\n"
        "  rebound compare few/indirect.exr whole/indirect.exr --surfaces truth\n"
        "  rebound compare out/indirect.exr truth.exr --mask lit.exr --out errors.png --largest 0.1 --json");
    return [options] { return exitCodeOf(compare(*options)); };
}

} // namespace rebound::cli
