// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "lab/files/run_program.hpp"
#include "lab/images/image_files.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

namespace rebound::cli {
namespace {

namespace fs = std::filesystem;

// Of this process and of those that it starts; back to what it was at the end.
class SearchPath {
public:
    explicit SearchPath(const fs::path& folder) {
        if (const char* before = std::getenv("PATH")) old = before;
        setenv("PATH", (folder.string() + ":/nowhere").c_str(), 1);
    }
    SearchPath(const SearchPath&) = delete;
    SearchPath& operator=(const SearchPath&) = delete;
    ~SearchPath() { setenv("PATH", old.c_str(), 1); }

private:
    std::string old;
};

constexpr const char* sequence = "render builtin:cornell --size 32x24 --frames 3 --fps 2 --out walk";

TEST_CASE("a sequence is numbered pictures, light, motion and timings") {
    const lab::TemporaryFolder folder, nothing;
    const Outcome outcome = [&] {
        const SearchPath withoutVideo(nothing.path());
        return run(sequence, folder.path());
    }();
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(outcome.output.find("ffmpeg is not in PATH") != std::string::npos);
    const fs::path walk = folder / "walk";
    for (const char* name : {"final_0000.png", "final_0001.png", "final_0002.png", "indirect_0000.exr",
                             "indirect_0002.exr", "motion_0001.exr", "motion_0002.exr"})
        CHECK_MESSAGE(fs::is_regular_file(walk / name), name);
    for (const char* name : {"final_0003.png", "motion_0000.exr", "sequence.mp4"})
        CHECK_MESSAGE(!fs::exists(walk / name), name);
    CHECK(lab::readText(walk / "final_0000.png") != lab::readText(walk / "final_0002.png"));
    const auto motion = lab::readExr(walk / "motion_0001.exr");
    REQUIRE(motion);
    CHECK(std::any_of(motion->data.begin(), motion->data.end(), [](float m) { return std::abs(m) > 0.5f; }));
    const auto json = nlohmann::json::parse(lab::readText(walk / "timings.json"));
    CHECK(json.at("frames") == 3);
    CHECK(json.at("frame_ms").size() == 3);
    CHECK(json.at("frames_per_second") == 2.0);
}

TEST_CASE("a sequence's first frame is the picture of its camera") {
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "path.json", R"({"camera": [
        {"time_s": 0, "position": [0.5, 2.7, 9], "target": [0, 2.7, 0], "vfov_degrees": 40}]})");
    lab::writeText(folder / "view.json",
                   R"({"units": {}, "cameras": [{"name": "front", "position": [0.5, 2.7, 9],
        "target": [0, 2.7, 0], "vfov_degrees": 40}], "lights": [{"type": "point", "color": [1, 1, 1], "intensity": 9,
        "position": [0, 4, 0]}], "environment": {"type": "constant", "radiance": [0, 0, 0]}, "emissive_materials": false})");
    const std::string common = "render builtin:cornell --size 40x30 --view view.json ";
    const Outcome moving = run(common + "--frames 2 --path path.json --out moving", folder.path());
    REQUIRE_MESSAGE(moving.exitCode == 0, moving.errors);
    REQUIRE(run(common + "--out still", folder.path()).exitCode == 0);
    CHECK(lab::readText(folder / "moving" / "indirect_0000.exr") ==
          lab::readText(folder / "still" / "indirect.exr"));
    // Nothing moves after the only key.
    CHECK(lab::readText(folder / "moving" / "final_0000.png") ==
          lab::readText(folder / "moving" / "final_0001.png"));
}

TEST_CASE("where ffmpeg is present there is a video") {
    if (!lab::findProgram("ffmpeg")) {
        MESSAGE("skipped: ffmpeg is not in PATH");
        return;
    }
    const lab::TemporaryFolder folder;
    const Outcome outcome = run("render builtin:cornell --size 31x23 --frames 3 --out walk", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(fs::file_size(folder / "walk" / "sequence.mp4") > 100);
}

TEST_CASE("an ffmpeg that fails leaves nothing behind") {
    const lab::TemporaryFolder folder, tools;
    lab::writeText(tools / "ffmpeg", "#!/bin/sh\necho 'no such encoder' >&2\nexit 1\n");
    fs::permissions(tools / "ffmpeg", fs::perms::owner_all);
    const SearchPath broken(tools.path());
    checkRefused(run(sequence, folder.path()), {"ffmpeg could not make the video: no such encoder"});
    CHECK(!fs::exists(folder / "walk"));
}

struct Refused {
    std::string arguments;
    std::initializer_list<std::string> texts;
};

TEST_CASE("sequences refuse what they cannot do in one sentence") {
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "backwards.json", R"({"camera": [
        {"time_s": 1, "position": [0, 2, 9], "target": [0, 2, 0]}, {"time_s": 0.5, "position": [0, 2, 8], "target": [0, 2, 0]}]})");
    lab::writeText(folder / "unknown.json", R"({"objects": {"wagon": {"keys": [{"time_s": 0}]}}})");
    lab::writeText(folder / "empty.json", "{}");
    const Refused all[] = {
        {"--frames 0", {"--frames is 0; 1 to 10000"}},
        {"--frames -3", {"--frames"}},
        {"--frames 10001", {"--frames is 10001"}},
        {"--frames many", {"--frames"}},
        {"--frames 2 --fps 0", {"--fps is 0; 0.01 to 1000"}},
        {"--frames 2 --fps nan", {"--fps is nan"}},
        {"--frames 2 --path ''", {"--path is empty"}},
        {"--frames 2 --path missing.json", {"missing.json"}},
        {"--frames 2 --path backwards.json",
         {"backwards.json", "camera[1].time_s is 0.5", "after the key before"}},
        {"--frames 2 --path unknown.json", {"wagon", "short block"}},
        {"--frames 2 --path empty.json", {"empty.json", "moves nothing"}},
        {"--path backwards.json", {"--frames is missing"}},
        {"--fps 30", {"--frames is missing"}},
        {"--frames 2 --technique reference",
         {"--frames was given, which --technique reference does not use"}},
    };
    for (const auto& [arguments, texts] : all) {
        CAPTURE(arguments);
        checkRefused(run("render builtin:cornell --size 16x12 --out walk " + arguments, folder.path()),
                     texts);
        CHECK(!fs::exists(folder / "walk"));
    }
    lab::writeText(folder / "still.gltf", "{}");
    checkRefused(run("render still.gltf --frames 2 --out walk", folder.path()),
                 {"--path is missing", "still.gltf"});
}

} // namespace
} // namespace rebound::cli
