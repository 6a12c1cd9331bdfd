// SPDX-License-Identifier: MIT
// Baking from the command line, and rendering with what was baked.
#include "command_line.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/images/image_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

namespace rebound::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* smallBake = "bake builtin:cornell --surfels 600 --caches 300 --links 24 --out ";

std::string bytesOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

double meanOf(const fs::path& file) {
    const auto image = lab::readExr(file);
    REQUIRE(image);
    double sum = 0.0;
    for (const float value : image->data) {
        REQUIRE(std::isfinite(value));
        sum += double(value);
    }
    return sum / double(image->data.size());
}

} // namespace

TEST_CASE("a bake is the same for any number of threads, and lights a picture") {
    const lab::TemporaryFolder folder;
    const Outcome one = run(std::string(smallBake) + "one.bake --threads 1", folder.path());
    REQUIRE_MESSAGE(one.exitCode == 0, one.errors);
    const Outcome three = run(std::string(smallBake) + "three.bake --threads 3", folder.path());
    REQUIRE_MESSAGE(three.exitCode == 0, three.errors);
    CHECK(bytesOf(folder.path() / "one.bake") == bytesOf(folder.path() / "three.bake"));

    const Outcome lit = run("render builtin:cornell --technique composition --bake one.bake --size 160x90 "
                            "--out lit",
                            folder.path());
    REQUIRE_MESSAGE(lit.exitCode == 0, lit.errors);
    const Outcome once = run("render builtin:cornell --technique composition --bake one.bake --feedback off "
                             "--size 160x90 --out once",
                             folder.path());
    REQUIRE_MESSAGE(once.exitCode == 0, once.errors);
    const double allBounces = meanOf(folder.path() / "lit" / "indirect.exr");
    const double firstBounce = meanOf(folder.path() / "once" / "indirect.exr");
    CHECK(firstBounce > 0.0);
    CHECK(allBounces > 1.1 * firstBounce);
}

TEST_CASE("pictures of a bake are drawn") {
    const lab::TemporaryFolder folder;
    const Outcome shown =
        run("bake builtin:cornell --surfels 600 --caches 300 --lightmap 400 --links 24 --show shown --size "
            "96x54",
            folder.path());
    REQUIRE_MESSAGE(shown.exitCode == 0, shown.errors);
    for (const char* name : {"surfels", "patches_16", "patches_128", "patches_1024", "caches", "links",
                             "light_map", "contact_sheet"})
        CHECK(fs::file_size(folder.path() / "shown" / (std::string(name) + ".png")) > 100);
}

TEST_CASE("a light map gives nearly as much light as the grid of the same bake, and is read unless told "
          "otherwise") {
    const lab::TemporaryFolder folder;
    REQUIRE(run(std::string(smallBake) + "map.bake --lightmap 1500", folder.path()).exitCode == 0);
    double light[2];
    for (const bool grid : {false, true}) {
        const Outcome lit =
            run("render builtin:cornell --technique composition --bake map.bake --size 160x90 "
                "--out lit" +
                    std::string(grid ? " --static-light grid" : ""),
                folder.path());
        REQUIRE_MESSAGE(lit.exitCode == 0, lit.errors);
        light[grid ? 1 : 0] = meanOf(folder.path() / "lit" / "indirect.exr");
    }
    CHECK(light[0] != light[1]);
    CHECK(light[0] == doctest::Approx(light[1]).epsilon(0.1)); // detail that a grid of few caches lacks
}

TEST_CASE("what cannot be baked or read is refused in one sentence") {
    const lab::TemporaryFolder folder;
    const auto refused = [&](const std::string& arguments, std::initializer_list<std::string> texts) {
        checkRefused(run(arguments, folder.path()), texts);
    };
    refused("bake builtin:cornell", {"--out"});
    refused("bake builtin:cornell --links 0 --out x", {"--links", "0"});
    refused("bake builtin:cornell --bands 9 --out x", {"--bands", "9"});
    refused("bake builtin:cornell --lightmap 2000000 --out x", {"--lightmap", "2000000", "1048576"});
    refused("render builtin:cornell --technique composition --static-light map",
            {"--static-light", "lightmap, grid"});
    refused("bake builtin:cornell --quality best --out x", {"--quality", "best", "moderate, high"});
    refused("bake builtin:cornell --hierarchy tree --out x", {"--hierarchy", "cluster, paper, kdtree"});
    refused("bake builtin:cornell --surfels 600 --caches 300 --links 24 --out missing/x", {"missing"});
    refused("render builtin:cornell --technique composition --bake none.bake", {"none.bake"});
    refused("render builtin:cornell --technique composition --bake", {"--bake"});
    refused("render builtin:cornell --technique composition --bake x --links 5", {"--links", "--bake"});
    refused("render builtin:cornell --bake x", {"--bake", "screen_indirect"});
    CHECK_FALSE(fs::exists(folder.path() / "x"));

    REQUIRE(run(std::string(smallBake) + "good.bake", folder.path()).exitCode == 0);
    std::string bytes = bytesOf(folder.path() / "good.bake");
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(folder.path() / "altered.bake", std::ios::binary) << bytes;
    refused("render builtin:cornell --technique composition --bake altered.bake", {"altered.bake"});
    refused("render builtin:atrium --technique composition --bake good.bake --size 64x36",
            {"good.bake", "scene"});
}

TEST_CASE("a stored frame has no scene to be baked") {
    const lab::TemporaryFolder folder;
    const Outcome stored =
        run("render builtin:cornell --technique reference --bounces 1 --spp 8 --size 64x36 "
            "--out frame",
            folder.path());
    REQUIRE_MESSAGE(stored.exitCode == 0, stored.errors);
    checkRefused(run("render --frame frame --technique composition", folder.path()), {"scene", "frame"});
}

} // namespace rebound::cli
