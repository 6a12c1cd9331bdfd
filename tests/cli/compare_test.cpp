// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "lab/images/image_files.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace rebound::cli {
namespace {

using doctest::Approx;

const float nan = std::nanf("");

// truth.exr is 2 everywhere, test.exr half brighter, both in single precision.
class Pictures {
public:
    Pictures() {
        write("truth.exr", truth());
        write("test.exr", lab::Image({20, 12}, 3, 2.5f));
    }

    static lab::Image truth() { return lab::Image({20, 12}, 3, 2.0f); }
    void write(const std::string& name, const lab::Image& image) const {
        REQUIRE(lab::writeExr(folder / name, image, lab::ExrPrecision::full));
    }
    Outcome compare(const std::string& arguments) const { return run("compare " + arguments, folder.path()); }
    nlohmann::json compareToJson(const std::string& arguments) const {
        const Outcome outcome = compare(arguments + " --json");
        REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
        CHECK(outcome.errors.empty());
        return nlohmann::json::parse(outcome.output);
    }
    size_t files() const { return folder.count(); }
    std::filesystem::path operator/(const std::string& name) const { return folder / name; }

private:
    lab::TemporaryFolder folder;
};

TEST_CASE("compare prints every measure, what it means and what was left out") {
    const Pictures pictures;
    const Outcome outcome = pictures.compare("test.exr truth.exr");
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.errors);
    CHECK(outcome.errors.empty());
    for (const char* text :
         {"test.exr against truth.exr, 20x12", "240 pixels compared", "0 left out", "RMSE", "0.5", "relMSE",
          "SMAPE", "bias", "95th percentile", "SSIM", "FLIP", "exposure", "67 pixels per degree"})
        CHECK_MESSAGE(outcome.output.find(text) != std::string::npos, text);
    CHECK(pictures.files() == 2);
}

TEST_CASE("two halves of the truth, or a figure, take its noise out of RMSE") {
    const Pictures pictures;
    pictures.write("a.exr", lab::Image({20, 12}, 3, 1.0f));
    pictures.write("b.exr", lab::Image({20, 12}, 3, 2.0f));
    const nlohmann::json halves = pictures.compareToJson("test.exr a.exr b.exr");
    // (2.5 - 1) (2.5 - 2), over a mean of 1.5; half the halves' difference is noise.
    CHECK(halves.at("rmse") == Approx(std::sqrt(0.75)));
    CHECK(halves.at("truth_mean") == 1.5);
    CHECK(halves.at("truth_noise") == Approx(0.5 / 1.5));
    CHECK(halves.at("relative_rmse_error").get<double>() > 0.0);
    CHECK(halves.at("truth_b") == "b.exr");
    const nlohmann::json figure = pictures.compareToJson("test.exr truth.exr --truth-noise 0.15");
    CHECK(figure.at("rmse") == Approx(std::sqrt(0.25 - 0.09)));
    CHECK(figure.at("relative_rmse_error").is_null());
    CHECK(pictures.compareToJson("test.exr truth.exr").at("truth_noise").is_null());
    const Outcome table = pictures.compare("test.exr a.exr b.exr");
    for (const char* text : {"test.exr against a.exr and b.exr", "standard error", "truth noise"})
        CHECK_MESSAGE(table.output.find(text) != std::string::npos, text);
    checkRefused(pictures.compare("test.exr a.exr b.exr --truth-noise 0.1"), {"--truth-noise", "halves"});
    checkRefused(pictures.compare("test.exr truth.exr --truth-noise -1"), {"--truth-noise is -1", "0 to 10"});
    checkRefused(pictures.compare("test.exr a.exr missing.exr"), {"missing.exr"});
    pictures.write("small.exr", lab::Image({10, 12}, 3, 2.0f));
    checkRefused(pictures.compare("test.exr a.exr small.exr"), {"a.exr and small.exr", "halves"});
}

TEST_CASE("--json has the numbers") {
    const Pictures pictures;
    const nlohmann::json json =
        pictures.compareToJson("test.exr truth.exr --exposure 0.25 --pixels-per-degree 40");
    CHECK(json.at("test") == "test.exr");
    CHECK(json.at("truth") == "truth.exr");
    CHECK(json.at("mask").is_null());
    CHECK(json.at("resolution") == nlohmann::json::array({20, 12}));
    CHECK(json.at("channels") == 3);
    CHECK(json.at("exposure") == 0.25);
    CHECK(json.at("pixels_per_degree") == 40.0);
    CHECK(json.at("pixels") == 240);
    CHECK(json.at("not_finite") == 0);
    CHECK(json.at("mean") == 2.5);
    CHECK(json.at("truth_mean") == 2.0);
    const double rounding = 1e-12; // of a sum of 720 doubles
    CHECK(json.at("bias").get<double>() == Approx(0.5).epsilon(rounding));
    CHECK(json.at("rmse").get<double>() == Approx(0.5).epsilon(rounding));
    CHECK(json.at("relative_rmse").get<double>() == Approx(0.25).epsilon(rounding));
    CHECK(json.at("rel_mse").get<double>() == Approx(0.25 / 4.0004).epsilon(rounding));
    CHECK(json.at("smape").get<double>() == Approx(1.0 / 4.5).epsilon(rounding));
    CHECK(json.at("percentile_95") == 0.5);
    CHECK(json.at("percentile_99") == 0.5);
    CHECK(json.at("ssim").get<double>() < 1.0);
    CHECK(json.at("flip").get<double>() > 0.0);
    // Another exposure and another observer see something else; numbers of radiance stay.
    const nlohmann::json other = pictures.compareToJson("test.exr truth.exr --exposure 1");
    CHECK(other.at("rmse") == json.at("rmse"));
    CHECK(other.at("ssim") != json.at("ssim"));
    CHECK(other.at("flip") != json.at("flip"));
}

TEST_CASE("pixels that are not finite are reported by the picture they are in") {
    const Pictures pictures;
    lab::Image test = Pictures::truth(), truth = Pictures::truth();
    test.at(1, 1)[0] = nan;
    test.at(2, 1)[2] = nan;
    truth.at(1, 1)[1] = nan;
    pictures.write("a.exr", test);
    pictures.write("b.exr", truth);
    const Outcome outcome = pictures.compare("a.exr b.exr");
    CHECK(outcome.output.find("238 pixels compared, 2 left out as not finite (2 in a.exr, 1 in b.exr)") !=
          std::string::npos);
    const nlohmann::json json = pictures.compareToJson("a.exr b.exr");
    CHECK(json.at("not_finite") == 2);
    CHECK(json.at("not_finite_in_test") == 2);
    CHECK(json.at("not_finite_in_truth") == 1);
    CHECK(json.at("rmse") == 0.0);
    CHECK(json.at("flip") == 0.0);
}

TEST_CASE("a mask leaves pixels out") {
    const Pictures pictures;
    lab::Image test = Pictures::truth(), mask({20, 12}, 1, 1.0f);
    test.at(4, 4)[0] = 100.0f;
    *mask.at(4, 4) = 0.0f;
    pictures.write("outlier.exr", test);
    pictures.write("mask.exr", mask);
    CHECK(pictures.compareToJson("outlier.exr truth.exr").at("rmse") > 0.0);
    const nlohmann::json json = pictures.compareToJson("outlier.exr truth.exr --mask mask.exr");
    CHECK(json.at("rmse") == 0.0);
    CHECK(json.at("masked_out") == 1);
    CHECK(json.at("mask") == "mask.exr");
    CHECK(pictures.compare("outlier.exr truth.exr --mask mask.exr").output.find("1 masked out") !=
          std::string::npos);
}

TEST_CASE("surfaces tell how much pattern the difference has") {
    const Pictures pictures;
    lab::Image striped({20, 12}, 3, 2.0f); // two blocks fit: the left one 0.4 brighter
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c) striped.at(x, y)[c] = 2.4f;
    pictures.write("striped.exr", striped);
    std::filesystem::create_directory(pictures / "frame");
    lab::Image normal({20, 12}, 3);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 20; ++x) normal.at(x, y)[1] = 1.0f;
    pictures.write("frame/depth.exr", lab::Image({20, 12}, 1, 3.0f));
    pictures.write("frame/normal.exr", normal);
    const nlohmann::json json = pictures.compareToJson("striped.exr truth.exr --surfaces frame");
    CHECK(json.at("pattern").get<double>() == Approx(0.2 / 2.0));
    CHECK(json.at("smooth_blocks") == 2);
    CHECK(json.at("surfaces") == "frame");
    const Outcome table = pictures.compare("striped.exr truth.exr --surfaces frame");
    CHECK(table.output.find("2 blocks on smooth surfaces of frame") != std::string::npos);
    CHECK(pictures.compareToJson("striped.exr truth.exr").at("pattern").is_null());
    checkRefused(pictures.compare("striped.exr truth.exr --surfaces missing"), {"missing/depth.exr"});
    checkRefused(pictures.compare("striped.exr truth.exr --surfaces ''"), {"--surfaces", "folder"});
    pictures.write("frame/depth.exr", lab::Image({20, 11}, 1, 3.0f));
    checkRefused(pictures.compare("striped.exr truth.exr --surfaces frame"), {"frame", "depth is 20x11"});
}

TEST_CASE("relative measures of a black truth are absent, not a number that is none") {
    const Pictures pictures;
    pictures.write("black.exr", lab::Image({20, 12}, 3, 0.0f));
    const nlohmann::json json = pictures.compareToJson("test.exr black.exr");
    CHECK(json.at("relative_rmse").is_null());
    CHECK(json.at("rel_mse").is_null());
    CHECK(json.at("rmse") == 2.5);
    const Outcome outcome = pictures.compare("test.exr black.exr");
    CHECK(outcome.output.find("relMSE                      -  ") != std::string::npos);
    CHECK(outcome.output.find("nan") == std::string::npos);
}

TEST_CASE("--out writes a picture of the errors") {
    const Pictures pictures;
    REQUIRE(pictures.compare("test.exr truth.exr --out automatic.png").exitCode == 0);
    REQUIRE(pictures.compare("test.exr truth.exr --out chosen.png --largest 20").exitCode == 0);
    const std::string automatic = lab::readText(pictures / "automatic.png");
    CHECK(automatic.starts_with("\x89PNG"));
    CHECK(lab::readText(pictures / "chosen.png") != automatic);
    CHECK(pictures.files() == 4);
}

TEST_CASE("an alpha channel is dropped, one channel is compared with one") {
    const Pictures pictures;
    lab::Image withAlpha({20, 12}, 4, 2.0f);
    for (size_t i = 3; i < withAlpha.data.size(); i += 4) withAlpha.data[i] = 0.5f;
    pictures.write("alpha.exr", withAlpha);
    CHECK(pictures.compareToJson("alpha.exr truth.exr").at("rmse") == 0.0);
    pictures.write("grey.exr", lab::Image({20, 12}, 1, 2.0f));
    CHECK(pictures.compareToJson("grey.exr grey.exr").at("channels") == 1);
}

TEST_CASE("what cannot be compared is one sentence, and leaves nothing behind") {
    const Pictures pictures;
    pictures.write("small.exr", lab::Image({19, 12}, 3, 2.0f));
    pictures.write("grey.exr", lab::Image({20, 12}, 1, 2.0f));
    pictures.write("nan.exr", lab::Image({20, 12}, 3, nan));
    pictures.write("nothing.exr", lab::Image({20, 12}, 1, 0.0f));
    lab::writeText(pictures / "broken.exr", "no picture");
    const size_t before = pictures.files();
    const struct {
        const char* arguments;
        std::initializer_list<std::string> says;
    } all[] = {
        {"", {"TEST"}},
        {"test.exr", {"TRUTH"}},
        {"test.exr truth.exr surplus.exr", {"surplus.exr"}},
        {"missing.exr truth.exr", {"missing.exr"}},
        {"test.exr missing.exr", {"missing.exr"}},
        {"broken.exr truth.exr", {"broken.exr"}},
        {"small.exr truth.exr --out e.png", {"small.exr", "truth.exr", "19x12", "20x12"}},
        {"grey.exr truth.exr", {"grey.exr", "1 channel, the truth 3"}},
        {"nan.exr truth.exr --out e.png", {"nan.exr", "240 are not finite"}},
        {"test.exr nan.exr", {"nan.exr", "240 are not finite"}},
        {"test.exr truth.exr --mask missing.exr", {"missing.exr"}},
        {"test.exr truth.exr --mask ''", {"--mask is empty"}},
        {"test.exr truth.exr --mask truth.exr", {"mask truth.exr", "3 channels; 1 was"}},
        {"grey.exr grey.exr --mask small.exr", {"small.exr", "19x12"}},
        {"test.exr truth.exr --mask nothing.exr", {"nothing.exr", "240 are masked out"}},
        {"test.exr truth.exr --exposure 0", {"--exposure is 0", "1e-30"}},
        {"test.exr truth.exr --exposure -1", {"--exposure is -1"}},
        {"test.exr truth.exr --exposure nan", {"--exposure is nan"}},
        {"test.exr truth.exr --exposure bright", {"--exposure", "bright"}},
        {"test.exr truth.exr --exposure 1e300", {"--exposure"}},
        {"test.exr truth.exr --pixels-per-degree 0.5", {"--pixels-per-degree is 0.5", "1 to 1000"}},
        {"test.exr truth.exr --pixels-per-degree 1001", {"--pixels-per-degree is 1001"}},
        {"test.exr truth.exr --pixels-per-degree nan", {"--pixels-per-degree"}},
        {"test.exr truth.exr --largest 0 --out e.png", {"--largest is 0", "above 0"}},
        {"test.exr truth.exr --largest inf --out e.png", {"--largest is inf"}},
        {"test.exr truth.exr --largest nan", {"--largest"}},
        {"test.exr truth.exr --out truth.exr", {"--out", "truth.exr", ".png"}},
        {"test.exr truth.exr --out ''", {"--out", ".png"}},
        {"test.exr truth.exr --out missing/e.png", {"missing/e.png"}},
    };
    for (const auto& bad : all) {
        INFO("rebound compare ", bad.arguments);
        checkRefused(pictures.compare(bad.arguments), bad.says);
        CHECK(pictures.files() == before);
    }
}

} // namespace
} // namespace rebound::cli
