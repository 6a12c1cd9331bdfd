// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "lab/images/image_files.hpp"
#include "lab/rays/frame.hpp"
#include "lab/scenes/scene_files.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace rebound::cli {
namespace {

constexpr const char* outputs[] = {"direct.exr", "direct.png", "indirect.exr",      "indirect.png",
                                   "final.exr",  "final.png",  "contact_sheet.png", "timings.json"};

lab::Image read(const std::filesystem::path& file) {
    auto image = lab::readExr(file);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return *image;
}

lab::Frame cornellFrame(Extent2D extent) {
    const lab::Scene scene = lab::makeCornellBox();
    lab::FrameOptions options;
    options.extent = extent;
    auto frame = lab::renderFrame(scene, scene.cameras.at(0), options);
    REQUIRE(frame);
    return *frame;
}

TEST_CASE("render writes direct, indirect and final light that fit together") {
    const lab::TemporaryFolder folder;
    const Outcome outcome = run("render builtin:cornell --size 96x64 --out result", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(outcome.errors.empty());
    for (const char* name : outputs)
        CHECK_MESSAGE(std::filesystem::file_size(folder / "result" / name) > 0, name);
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "result"), {}) == std::size(outputs));

    const lab::Image direct = read(folder / "result" / "direct.exr");
    const lab::Image indirect = read(folder / "result" / "indirect.exr");
    const lab::Image final = read(folder / "result" / "final.exr");
    const lab::Frame frame = cornellFrame({96, 64});
    const lab::Image outgoing = lab::outgoingRadiance(frame);
    for (const lab::Image* image : {&direct, &indirect, &final}) {
        REQUIRE(image->extent() == Extent2D{96, 64});
        REQUIRE(image->channels == 3);
    }
    double indirectSum = 0.0;
    for (size_t i = 0; i < final.data.size(); ++i) {
        // Half precision rounds each operand and the sum by up to 2^-11 of it, and by 2^-25 near zero.
        const double bound = std::ldexp(1.0, -11);
        CHECK(std::abs(double(direct.data[i]) - double(outgoing.data[i])) <=
              bound * double(outgoing.data[i]) + std::ldexp(1.0, -24));
        const double expected =
            double(direct.data[i]) + double(frame.albedo.data[i]) * double(indirect.data[i]);
        CHECK(std::abs(double(final.data[i]) - expected) <= 3.0 * bound * expected + std::ldexp(1.0, -24));
        indirectSum += double(indirect.data[i]);
    }
    CHECK(indirectSum > 0.0);
}

TEST_CASE("timings.json holds what the table shows") {
    const lab::TemporaryFolder folder;
    const Outcome outcome =
        run("render builtin:cornell --size 96x64 --levels 3 --threads 1 --out result", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const auto json = nlohmann::json::parse(lab::readText(folder / "result" / "timings.json"));
    double sum = 0.0;
    int gathers = 0;
    for (const auto& pass : json.at("passes")) {
        const std::string name = pass.at("name");
        CHECK(pass.at("ms").get<double>() >= 0.0);
        CHECK(outcome.output.find(name) != std::string::npos);
        sum += pass.at("ms").get<double>();
        gathers += name.find("gather") != std::string::npos;
    }
    CHECK(gathers == 3);
    CHECK(sum > 0.0);
    CHECK(sum <= json.at("frame").at("ms").get<double>());
    CHECK(json.at("resolution") == nlohmann::json::array({96, 64}));
    CHECK(json.at("settings").at("levels") == 3);
    CHECK(json.at("settings").at("samples_per_level") == 64);
    CHECK(json.at("threads") == 1);
    const auto& memory = json.at("memory");
    CHECK(memory.at("total_bytes") ==
          memory.at("transient_bytes").get<size_t>() + memory.at("buffer_bytes").get<size_t>());
}

TEST_CASE("the outputs are the same bit for bit with any number of threads") {
    const lab::TemporaryFolder folder;
    for (const char* threads : {"1", "2"})
        REQUIRE(
            run(std::string("render builtin:cornell --size 96x64 --threads ") + threads + " --out " + threads,
                folder.path())
                .exitCode == 0);
    for (const char* name : outputs)
        if (std::string(name) != "timings.json")
            CHECK_MESSAGE(lab::readText(folder / "1" / name) == lab::readText(folder / "2" / name), name);
}

TEST_CASE("--precision float writes single precision") {
    const lab::TemporaryFolder folder;
    REQUIRE(
        run("render builtin:cornell --size 24x16 --precision float --out result", folder.path()).exitCode ==
        0);
    const lab::Image direct = read(folder / "result" / "direct.exr");
    CHECK(direct.data == lab::outgoingRadiance(cornellFrame({24, 16})).data);
}

TEST_CASE("pictures of one pixel, one row and one column work") {
    const lab::TemporaryFolder folder;
    for (const char* size : {"1x1", "33x1", "1x17"}) {
        const Outcome outcome =
            run(std::string("render builtin:cornell --size ") + size + " --out result", folder.path());
        CHECK_MESSAGE(outcome.exitCode == 0, outcome.errors);
    }
    CHECK(read(folder / "result" / "final.exr").extent() == Extent2D{1, 17});
}

TEST_CASE("--only-level shows parts whose sum is the whole") {
    const lab::TemporaryFolder folder;
    const std::string common = "render builtin:cornell --size 48x32 --levels 2 --precision float --out ";
    REQUIRE(run(common + "all", folder.path()).exitCode == 0);
    REQUIRE(run(common + "fine --only-level 0", folder.path()).exitCode == 0);
    REQUIRE(run(common + "coarse --only-level 1", folder.path()).exitCode == 0);
    const lab::Image all = read(folder / "all" / "indirect.exr");
    const lab::Image fine = read(folder / "fine" / "indirect.exr");
    const lab::Image coarse = read(folder / "coarse" / "indirect.exr");
    for (size_t i = 0; i < all.data.size(); ++i)
        // Light moves between levels linearly, so that only rounding tells them apart: a few dozen
        // operations.
        CHECK(double(fine.data[i]) + double(coarse.data[i]) ==
              doctest::Approx(double(all.data[i])).epsilon(1e-4).scale(1e-3));
}

TEST_CASE("a second run replaces the outputs of the first, and nothing else") {
    const lab::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "result");
    lab::writeText(folder / "result" / "notes.txt", "mine");
    REQUIRE(run("render builtin:cornell --size 8x8 --out result", folder.path()).exitCode == 0);
    REQUIRE(run("render builtin:cornell --size 9x7 --out result", folder.path()).exitCode == 0);
    CHECK(read(folder / "result" / "direct.exr").extent() == Extent2D{9, 7});
    CHECK(lab::readText(folder / "result" / "notes.txt") == "mine");
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "result"), {}) ==
          std::size(outputs) + 1);
}

TEST_CASE("a run that cannot replace one output leaves all as they were") {
    const lab::TemporaryFolder folder;
    REQUIRE(run("render builtin:cornell --size 8x8 --out result", folder.path()).exitCode == 0);
    std::filesystem::remove(folder / "result" / "final.exr");
    std::filesystem::create_directory(folder / "result" / "final.exr");
    const std::string before = lab::readText(folder / "result" / "direct.exr");
    checkRefused(run("render builtin:cornell --size 9x7 --out result", folder.path()),
                 {"final.exr", "folder"});
    CHECK(lab::readText(folder / "result" / "direct.exr") == before);
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "result"), {}) == std::size(outputs));
}

} // namespace
} // namespace rebound::cli
