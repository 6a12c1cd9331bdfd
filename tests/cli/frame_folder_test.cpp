// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "lab/images/image_files.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace rebound::cli {
namespace {

constexpr Extent2D extent{12, 8};

lab::Image constant(int channels, std::array<float, 3> value) {
    lab::Image image(extent, channels);
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = value[i % size_t(channels)];
    return image;
}

// A lit wall that faces the camera, 2 m away.
struct Draft {
    lab::Image depth = constant(1, {2, 0, 0});
    lab::Image normal = constant(3, {0, 0, 1});
    lab::Image albedo = constant(3, {0.5f, 0.25f, 0.125f});
    lab::Image direct = constant(3, {1, 2, 4});
    std::string meta =
        R"({"camera": {"name": "front", "position": [0, 0, 0], "target": [0, 0, -1], "up": [0, 1, 0],
                           "vfov_degrees": 60, "near": 0.1, "far": 100}})";
};

void write(const Draft& draft, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    REQUIRE(lab::writeExr(folder / "depth.exr", draft.depth, lab::ExrPrecision::full));
    REQUIRE(lab::writeExr(folder / "normal.exr", draft.normal, lab::ExrPrecision::full));
    REQUIRE(lab::writeExr(folder / "albedo.exr", draft.albedo, lab::ExrPrecision::full));
    REQUIRE(lab::writeExr(folder / "direct.exr", draft.direct, lab::ExrPrecision::full));
    lab::writeText(folder / "meta.json", draft.meta);
}

TEST_CASE("a frame folder sends albedo * direct; its plane receives nothing from itself") {
    const lab::TemporaryFolder folder;
    write(Draft(), folder / "frame");
    const Outcome outcome = run("render --frame frame --out result", folder.path());
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    const auto direct = lab::readExr(folder / "result" / "direct.exr");
    const auto indirect = lab::readExr(folder / "result" / "indirect.exr");
    REQUIRE(direct);
    REQUIRE(indirect);
    REQUIRE(direct->extent() == extent);
    // 0.5 * 1, 0.25 * 2 and 0.125 * 4 are exact in every precision.
    CHECK(std::all_of(direct->data.begin(), direct->data.end(), [](float value) { return value == 0.5f; }));
    // Points of one plane do not see each other; positions and normals that were packed are off by a part in
    // thousands.
    CHECK(
        std::all_of(indirect->data.begin(), indirect->data.end(), [](float value) { return value >= 0.0f; }));
    CHECK(*std::max_element(indirect->data.begin(), indirect->data.end()) < 0.005f);
}

TEST_CASE("emission of a frame folder is sent and seen") {
    const lab::TemporaryFolder folder;
    write(Draft(), folder / "frame");
    REQUIRE(
        lab::writeExr(folder / "frame" / "emission.exr", constant(3, {3, 3, 3}), lab::ExrPrecision::full));
    REQUIRE(run("render --frame frame --out result", folder.path()).exitCode == 0);
    const auto direct = lab::readExr(folder / "result" / "direct.exr");
    REQUIRE(direct);
    CHECK(std::all_of(direct->data.begin(), direct->data.end(), [](float value) { return value == 3.5f; }));
}

TEST_CASE("frames with wrong pixels are refused: file, number and first pixel are named") {
    struct Spoiled {
        const char* file;
        std::function<void(Draft&)> spoil;
        std::initializer_list<std::string> says;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    const Spoiled all[] = {
        {"direct.exr",
         [=](Draft& d) { d.direct.at(3, 2)[1] = d.direct.at(5, 6)[0] = nan; },
         {"2 pixels", "3, 2"}},
        {"direct.exr", [=](Draft& d) { d.direct.at(4, 1)[2] = infinity; }, {"1 pixel ", "4, 1"}},
        {"direct.exr", [](Draft& d) { d.direct.at(0, 7)[0] = -1.0f; }, {"1 pixel ", "negative", "0, 7"}},
        {"albedo.exr", [=](Draft& d) { d.albedo.at(11, 0)[0] = nan; }, {"1 pixel ", "11, 0"}},
        {"albedo.exr", [](Draft& d) { d.albedo.at(1, 1)[0] = -0.5f; }, {"negative", "1, 1"}},
        {"albedo.exr", [](Draft& d) { d.albedo.at(1, 1)[0] = 1.5f; }, {"above 1", "1, 1"}},
        {"normal.exr", [](Draft& d) { d.normal = lab::Image(extent, 3); }, {"96 pixels", "0, 0"}},
        {"normal.exr", [](Draft& d) { d.normal.at(2, 2)[2] = 1.5f; }, {"1 pixel ", "too long", "2, 2"}},
        {"normal.exr",
         [](Draft& d) {
             d.normal = constant(3, {0, 0, 0.7f});
         },
         {"96 pixels", "too short", "0, 0"}},
        {"normal.exr", [=](Draft& d) { d.normal.at(2, 3)[0] = nan; }, {"1 pixel ", "2, 3"}},
        {"depth.exr", [=](Draft& d) { *d.depth.at(9, 4) = nan; }, {"1 pixel ", "9, 4"}},
        {"depth.exr", [=](Draft& d) { *d.depth.at(9, 4) = -infinity; }, {"1 pixel ", "9, 4"}},
        {"depth.exr", [](Draft& d) { *d.depth.at(9, 4) = -2.0f; }, {"negative", "9, 4"}},
    };
    const lab::TemporaryFolder folder;
    for (const Spoiled& spoiled : all) {
        INFO("spoiled: ", spoiled.file);
        Draft draft;
        spoiled.spoil(draft);
        write(draft, folder / "frame");
        const Outcome outcome = run("render --frame frame --out result", folder.path());
        checkRefused(outcome, spoiled.says);
        checkRefused(outcome, {spoiled.file});
        CHECK(folder.count() == 1); // the frame itself
    }
}

TEST_CASE("stored frames of another renderer pass the check") {
    const char* shared = std::getenv("REBOUND_SHARED");
    if (shared == nullptr) {
        MESSAGE("skipped: REBOUND_SHARED does not name the folder of scenes and reference images");
        return;
    }
    const lab::TemporaryFolder folder;
    for (const char* frame : {"sponza/arch", "arena/underpass"}) {
        const std::filesystem::path path = std::filesystem::path(shared) / "reference" / frame;
        const Outcome outcome = run("render --frame '" + path.string() + "' --out result", folder.path());
        CHECK_MESSAGE(outcome.exitCode == 0, outcome.errors);
        const auto stored = lab::readExr(path / "depth.exr");
        const auto indirect = lab::readExr(folder / "result" / "indirect.exr");
        REQUIRE(stored);
        REQUIRE(indirect);
        CHECK(indirect->extent() == stored->extent());
    }
}

TEST_CASE("an infinitely far pixel has no surface, and a note says so") {
    const lab::TemporaryFolder folder;
    Draft draft;
    *draft.depth.at(5, 5) = std::numeric_limits<float>::infinity();
    for (int c = 0; c < 3; ++c) draft.normal.at(5, 5)[c] = 0.0f;
    write(draft, folder / "frame");
    const Outcome outcome = run("render --frame frame --out result", folder.path());
    CHECK_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(outcome.output.find("note: frame/depth.exr: 1 pixel (1 %)") != std::string::npos);
}

TEST_CASE("pixels without a surface need no normal") {
    const lab::TemporaryFolder folder;
    Draft draft;
    *draft.depth.at(5, 5) = 0.0f;
    for (int c = 0; c < 3; ++c)
        draft.normal.at(5, 5)[c] = draft.albedo.at(5, 5)[c] = draft.direct.at(5, 5)[c] = 0.0f;
    write(draft, folder / "frame");
    CHECK(run("render --frame frame --out result", folder.path()).exitCode == 0);
}

TEST_CASE("frames of mismatched sizes, or with parts missing, are refused") {
    const lab::TemporaryFolder folder;
    Draft draft;
    draft.albedo = lab::Image({11, 8}, 3);
    write(draft, folder / "frame");
    checkRefused(run("render --frame frame --out result", folder.path()), {"albedo", "11", "12"});
    write(Draft(), folder / "frame");
    checkRefused(run("render --frame frame --camera other --out result", folder.path()), {"other", "front"});
    std::filesystem::remove(folder / "frame" / "direct.exr");
    checkRefused(run("render --frame frame --out result", folder.path()), {"direct.exr"});
    lab::writeText(folder / "frame" / "direct.exr", "no picture");
    checkRefused(run("render --frame frame --out result", folder.path()), {"direct.exr"});
    write(Draft(), folder / "frame");
    lab::writeText(folder / "frame" / "meta.json", "{");
    checkRefused(run("render --frame frame --out result", folder.path()), {"meta.json"});
    CHECK(folder.count() == 1);
}

} // namespace
} // namespace rebound::cli
