// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace rebound::cli {
namespace {

struct BadArguments {
    const char* arguments;
    std::initializer_list<std::string> says;
};

TEST_CASE("bad arguments are refused in one sentence, and leave nothing behind") {
    const BadArguments all[] = {
        {"", {"command"}},
        {"frobnicate", {"frobnicate"}},
        {"render --frobnicate", {"--frobnicate"}},
        {"render builtin:cornell surplus", {"surplus"}},
        {"render --size 0x0", {"--size", "0x0", "16384"}},
        {"render --size 1x", {"--size", "1x"}},
        {"render --size x1", {"--size", "x1"}},
        {"render --size 99999x1", {"--size", "99999x1", "16384"}},
        {"render --size 99999999999999x1", {"--size"}},
        {"render --size -4x4", {"--size", "-4x4"}},
        {"render --size 4x4x4", {"--size"}},
        {"render --size ''", {"--size"}},
        {"render --size", {"--size"}},
        {"render --preset fast", {"--preset", "fast", "quarter-64", "half-256-5"}},
        {"render --start tenth", {"--start", "tenth", "quarter"}},
        {"render --reduce sum", {"--reduce", "sum", "voting"}},
        {"render --form-factor none", {"--form-factor", "none", "disc"}},
        {"render --levels 0", {"--levels", "8"}},
        {"render --levels 9 --radius auto", {"--levels", "8"}},
        {"render --levels few", {"--levels", "few"}},
        {"render --levels 3 --levels 4", {"--levels"}},
        {"render --samples 3", {"--samples", "256"}},
        {"render --samples 0", {"--samples is \"0\"; 4 to 256, or all, was expected"}},
        {"render --samples every", {"--samples is \"every\"", "all"}},
        {"render --radius 0.5", {"--radius", "1024"}},
        {"render --radius nan", {"--radius", "nan"}},
        {"render --radius wide", {"--radius", "wide", "auto"}},
        {"render --smooth yes", {"--smooth is \"yes\"; one of on, off was expected"}},
        {"render --cover-screen 1", {"--cover-screen is \"1\"; one of on, off was expected"}},
        {"render --minimum-cosine nan", {"--minimum-cosine"}},
        {"render --only-level 4", {"--only-level", "3"}},
        {"render --only-level -1", {"--only-level"}},
        {"render --isa mmx", {"--isa", "mmx", "baseline"}},
        {"render --threads -1", {"--threads", "1024"}},
        {"render --threads 1025", {"--threads", "1024"}},
        {"render --precision double", {"--precision", "double", "half"}},
        {"render --light-samples 0", {"--light-samples"}},
        {"render --camera nobody --size 4x4", {"nobody", "nave"}},
        {"render ''", {"SCENE"}},
        {"render missing.gltf", {"missing.gltf"}},
        {"render builtin:palace", {"builtin:cornell"}},
        {"render builtin:cornell --view missing.json", {"missing.json"}},
        {"render builtin:cornell --time 1", {"--time", "builtin:cornell"}},
        {"render missing.gltf --time inf", {"--time"}},
        {"render --frame missing", {"missing"}},
        {"render --frame . --size 4x4", {"--frame", "--size"}},
        {"render builtin:cornell --frame .", {"--frame"}},
        {"bench --frames 0", {"--frames"}},
        {"bench --warm-up -1", {"--warm-up"}},
        {"bench --out result", {"--out"}},
        {"bench missing.gltf --json", {"missing.gltf"}},
        {"plan --size 0x4", {"--size"}},
        {"plan builtin:cornell", {"builtin:cornell"}},
    };
    const lab::TemporaryFolder folder;
    for (const BadArguments& bad : all) {
        INFO("rebound ", bad.arguments);
        checkRefused(run(bad.arguments, folder.path()), bad.says);
        CHECK(folder.count() == 0);
    }
}

TEST_CASE("an output folder that cannot be written to is refused") {
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "file", "mine");
    checkRefused(run("render builtin:cornell --size 4x4 --out file", folder.path()), {"file"});
    checkRefused(run("render builtin:cornell --size 4x4 --out file/below", folder.path()), {"file"});
    checkRefused(run("render builtin:cornell --size 4x4 --out ''", folder.path()), {"--out"});
    CHECK(lab::readText(folder / "file") == "mine");
    CHECK(folder.count() == 1);
}

TEST_CASE("a failure after the options were read leaves no folder behind") {
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "broken.gltf", "{");
    checkRefused(run("render broken.gltf --out a/b/c", folder.path()), {"broken.gltf"});
    CHECK(folder.count() == 1);
}

TEST_CASE("standard output that cannot be written to is a failure") {
    if (!std::filesystem::exists("/dev/full")) {
        MESSAGE("skipped: this system has no /dev/full");
        return;
    }
    const lab::TemporaryFolder folder;
    for (const char* arguments : {"plan", "--help", "bench builtin:cornell --size 4x4 --frames 1 --json"})
        checkRefused(run(arguments, folder.path(), "/dev/full"), {"standard output"});
}

} // namespace
} // namespace rebound::cli
