// SPDX-License-Identifier: MIT
// Frames of other programs, examined.
#include "command_line.hpp"

#include "lab/images/image_files.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <functional>

namespace rebound::cli {
namespace {

namespace fs = std::filesystem;

bool mentions(const std::string& text, const std::string& part) {
    INFO("it says: ", text, " and should say: ", part);
    const bool found = text.find(part) != std::string::npos;
    CHECK(found);
    return found;
}

lab::Image read(const fs::path& file) {
    auto image = lab::readExr(file);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return *image;
}

// A frame of the Cornell box, as render stores it.
void makeFrame(const lab::TemporaryFolder& folder) {
    const Outcome made =
        run("render builtin:cornell --camera corner --technique reference --bounces 1 --spp 8 --size "
            "160x90 --out frame",
            folder.path());
    REQUIRE_MESSAGE(made.exitCode == 0, made.errors);
}

void change(const fs::path& file, const std::function<void(lab::Image&)>& how) {
    lab::Image image = read(file);
    how(image);
    REQUIRE(lab::writeExr(file, image, lab::ExrPrecision::full));
}

} // namespace

TEST_CASE("check finds nothing in a right frame, and names what is wrong in others") {
    const lab::TemporaryFolder folder;
    makeFrame(folder);
    const Outcome right = run("check frame", folder.path());
    CHECK(right.exitCode == 0);
    mentions(right.output, "fit together");

    change(folder / "frame" / "normal.exr", [](lab::Image& image) {
        for (float& value : image.data) value = -value;
    });
    const Outcome flipped = run("check frame", folder.path());
    CHECK(flipped.exitCode == 1);
    CHECK(flipped.errors.empty());
    mentions(flipped.output, "mistake: ");
    const Outcome asJson = run("check frame --json", folder.path());
    CHECK(asJson.exitCode == 1);
    const auto json = nlohmann::json::parse(asJson.output);
    CHECK(json.at("frame_folder") == "frame");
    CHECK(json.at("resolution") == nlohmann::json::array({160, 90}));
    REQUIRE(json.at("findings").size() == 1);
    CHECK(json.at("findings")[0].at("problem") == "normalsFlipped");
    CHECK(json.at("findings")[0].at("certainty") == "mistake");

    // render says the same, and renders.
    const Outcome rendered = run("render --frame frame --out result", folder.path());
    CHECK(rendered.exitCode == 0);
    const std::string note = "note: " + json.at("findings")[0].at("sentence").get<std::string>();
    mentions(rendered.output, note);
    // So does bench, which would measure it without a word otherwise.
    const std::string bench = "bench --frame frame --frames 1 --warm-up 0";
    mentions(run(bench, folder.path()).output, note);
    mentions(run(bench + " --json", folder.path()).errors, note);
}

TEST_CASE("check goes on where render refuses pixels") {
    const lab::TemporaryFolder folder;
    makeFrame(folder);
    change(folder / "frame" / "albedo.exr", [](lab::Image& image) { image.data[0] = 3.0f; });
    const Outcome outcome = run("check frame", folder.path());
    CHECK(outcome.exitCode == 1);
    mentions(outcome.output, "albedo.exr: 1 pixel is above 1");
    checkRefused(run("render --frame frame --out result", folder.path()), {"albedo.exr: 1 pixel is above 1"});
}

TEST_CASE("check examines scenes, and names what their files hold beside") {
    const lab::TemporaryFolder folder;
    const Outcome outcome = run("check builtin:cornell --size 160x90", folder.path());
    CHECK(outcome.exitCode == 0);
    mentions(outcome.output, "builtin:cornell, camera front, 160x90");
    lab::writeText(folder / "view.json", R"({"enviroment": {}})");
    const Outcome noted = run("check builtin:cornell --size 96x54 --view view.json --json", folder.path());
    CHECK(noted.exitCode == 0);
    const auto json = nlohmann::json::parse(noted.output);
    REQUIRE(json.at("notes").size() == 1);
    mentions(json.at("notes")[0], "enviroment");
    const Outcome rendered =
        run("render builtin:cornell --size 8x8 --view view.json --out out", folder.path());
    mentions(rendered.output, "note: 'view.json': a view file has no key \"enviroment\"");
}

TEST_CASE("check refuses what is neither a frame nor a scene") {
    const lab::TemporaryFolder folder;
    checkRefused(run("check missing", folder.path()), {"missing"});
    checkRefused(run("check . --time 1", folder.path()), {"--time", "folder"});
    checkRefused(run("check .", folder.path()), {"meta.json"});
    checkRefused(run("check builtin:cornell --size 0x1", folder.path()), {"--size is \"0x1\""});
}

TEST_CASE("reported frames: what is wrong in them is named") {
    const char* shared = std::getenv("REBOUND_SHARED");
    const fs::path reports = fs::path(shared ? shared : "") / "reports";
    if (!shared || !fs::exists(reports)) {
        MESSAGE("skipped: REBOUND_SHARED names no folder with reports/");
        return;
    }
    const lab::TemporaryFolder folder;
    const auto check = [&](const char* frame) {
        return run("check '" + (reports / frame).string() + "'", folder.path());
    };
    CHECK(check("frame_not_examined/ok").exitCode == 0);
    CHECK(check("frame_not_examined/normal_flipped").exitCode == 1);
    mentions(check("exr_data_window/crop_all").output, "data window");
    const Outcome shifted = check("exr_data_window/offset_one");
    CHECK(shifted.exitCode == 1);
    mentions(shifted.output, "normal.exr: its data window");
    const Outcome compared = run("compare '" + (reports / "exr_data_window/off.exr").string() + "' '" +
                                     (reports / "exr_data_window/direct.exr").string() + "' --json",
                                 folder.path());
    CHECK(compared.exitCode == 0);
    CHECK(nlohmann::json::parse(compared.output).at("rmse").get<double>() > 0.0);
    const Outcome vectors = run("compare '" + (reports / "exr_xyz_channels/nA.exr").string() + "' '" +
                                    (reports / "exr_xyz_channels/nB.exr").string() + "' --json",
                                folder.path());
    CHECK(nlohmann::json::parse(vectors.output).at("rmse").get<double>() > 0.0);
}

} // namespace rebound::cli
