// SPDX-License-Identifier: MIT
// render --technique reference
#include "command_line.hpp"

#include "lab/images/image_files.hpp"
#include "lab/light/path_tracer.hpp"
#include "lab/rays/frame.hpp"
#include "lab/scenes/scene_files.hpp"

#include <nlohmann/json.hpp>

namespace rebound::cli {
namespace {

lab::Image read(const std::filesystem::path& file) {
    auto image = lab::readExr(file);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return *image;
}

constexpr const char* traceCornell =
    "render builtin:cornell --technique reference --size 32x24 --bounces 2 --spp 16";

TEST_CASE("a reference is the path tracer's light, in a folder that --frame takes") {
    const lab::TemporaryFolder folder;
    const Outcome outcome = run(std::string(traceCornell) + " --out truth", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(outcome.output.find("16 paths a pixel, up to 2 surfaces before the visible one") !=
          std::string::npos);

    const lab::Scene scene = lab::makeCornellBox();
    const auto light =
        lab::tracePaths(scene, scene.cameras[0], {.extent = {32, 24}, .bounces = 2, .samples = 16});
    REQUIRE(light);
    CHECK(read(folder / "truth/direct.exr").data == light->direct.data);
    CHECK(read(folder / "truth/first_bounce.exr").data == light->firstBounce.data);
    CHECK(read(folder / "truth/first_bounce_a.exr").data == light->firstBounceHalves[0].data);
    CHECK(read(folder / "truth/first_bounce_b.exr").data == light->firstBounceHalves[1].data);
    CHECK(read(folder / "truth/indirect_a.exr").data == light->indirectHalves[0].data);
    CHECK(read(folder / "truth/indirect_b.exr").data == light->indirectHalves[1].data);
    CHECK(read(folder / "truth/indirect.exr").data == light->indirect.data);
    CHECK(read(folder / "truth/standard_error.exr").data == light->standardError.data);
    const auto meta = nlohmann::json::parse(lab::readText(folder / "truth/meta.json"));
    CHECK(meta.at("samples") == 16);
    CHECK(meta.at("bounces") == 2);
    CHECK(meta.at("relative_error").get<double>() == doctest::Approx(light->relativeError));

    const auto frame = lab::readFrame(folder / "truth");
    REQUIRE_MESSAGE(frame, (frame ? "" : frame.error().message));
    CHECK(frame->camera.position == scene.cameras[0].position);
    const Outcome again = run("render --frame truth --out technique", folder.path());
    CHECK_MESSAGE(again.exitCode == 0, again.errors);
    const Outcome compared =
        run("compare technique/indirect.exr truth/first_bounce.exr --json", folder.path());
    CHECK_MESSAGE(compared.exitCode == 0, compared.errors);
}

TEST_CASE("a reference goes on where the last one stopped, with the bits of one run") {
    const lab::TemporaryFolder folder;
    REQUIRE(run(std::string(traceCornell) + " --out parts", folder.path()).exitCode == 0);
    const auto first = read(folder / "parts/indirect.exr").data;
    const std::string more =
        "render builtin:cornell --technique reference --size 32x24 --bounces 2 --spp 48 --out ";
    REQUIRE(run(more + "parts", folder.path()).exitCode == 0);
    REQUIRE(run(more + "whole --threads 1", folder.path()).exitCode == 0);
    CHECK(read(folder / "parts/indirect.exr").data == read(folder / "whole/indirect.exr").data);
    CHECK(read(folder / "parts/indirect.exr").data != first);
}

TEST_CASE("glossy surfaces add their reflection") {
    const lab::TemporaryFolder folder;
    REQUIRE(run(std::string(traceCornell) + " --glossy ggx --out shiny", folder.path()).exitCode == 0);
    const lab::Image glossy = read(folder / "shiny/glossy.exr");
    CHECK(std::any_of(glossy.data.begin(), glossy.data.end(), [](float value) { return value > 0.0f; }));
    REQUIRE(run(std::string(traceCornell) + " --out matt", folder.path()).exitCode == 0);
    CHECK(!std::filesystem::exists(folder / "matt/glossy.exr"));
}

TEST_CASE("options that do not fit together are refused") {
    const lab::TemporaryFolder folder;
    const auto refused = [&](const std::string& arguments, std::initializer_list<std::string> texts) {
        checkRefused(run("render builtin:cornell " + arguments, folder.path()), texts);
        CHECK(folder.count() == 0);
    };
    refused("--technique photons", {"--technique is \"photons\"", "screen_indirect, composition, reference"});
    refused("--spp 16", {"--spp was given, which --technique screen_indirect does not use"});
    refused("--technique reference --preset half-64",
            {"--preset was given, which --technique reference does not use"});
    refused("--technique reference --backend vulkan", {"--backend was given"});
    refused("--technique reference --bounces 65", {"--bounces is 65; expected 0 to 64"});
    refused("--technique reference --spp 0", {"--spp is 0; expected 1 to 1048576"});
    refused("--technique reference --error 2", {"--error is 2", "expected 0 to 1"});
    refused("--technique reference --glossy wet", {"--glossy is \"wet\"", "none, phong, blinn-phong, ggx"});
    refused("--technique reference --size 0x8", {"--size is \"0x8\""});
    refused("--technique reference --camera side", {"side"});
}

} // namespace
} // namespace rebound::cli
