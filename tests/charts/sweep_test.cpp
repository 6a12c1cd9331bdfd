// SPDX-License-Identifier: MIT
#include "../lab/temporary_folder.hpp"
#include "lab/charts/sweep.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

namespace rebound::charts {
namespace {

std::set<std::string> namesOf(const Sweep& sweep) {
    std::set<std::string> names;
    for (const Setting& setting : sweep.settings) names.insert(setting.name);
    return names;
}

TEST_CASE("arrays mean every combination, and what comes to the same is taken once") {
    const auto sweep = parseSweep(R"({"techniques": {"screen_indirect": [
        {"preset": "quarter-64"},
        {"preset": "half-64", "levels": 5, "samples": [16, 32, 64], "start": ["half", "quarter"]},
        {"preset": "half-64-5"}
    ]}})",
                                  "sweep");
    REQUIRE_MESSAGE(sweep, sweep.error().message);
    CHECK(namesOf(*sweep) == std::set<std::string>{"quarter-64", "half-16-5", "half-32-5", "half-64-5",
                                                   "quarter-16-5", "quarter-32-5", "quarter-64-5"});
    CHECK(sweep->settings.size() == 7); // half-64-5 twice
    CHECK(sweep->size == Extent2D{640, 360});
    CHECK(sweep->frames == 20);
    CHECK(sweep->warmUp == 3);
    CHECK(sweep->reference.bounces == 1);
    CHECK(sweep->backends == std::vector<std::string>{"cpu"});
}

TEST_CASE("a sweep's values reach the settings") {
    const auto sweep = parseSweep(R"({"techniques": {"screen_indirect": [
        {"start": "full", "levels": 3, "samples": 8, "radius": 12.5, "reduce": "nearest", "form_factor": "point",
         "minimum_cosine": 0.25, "cover_screen": "off", "smooth": "off"}, {"radius": "auto"}]},
        "backends": ["scalar", "cpu"],
        "scenes": ["builtin:cornell", {"scene": "hall.gltf", "view": "night.json", "cameras": ["door", "stage"]}],
        "size": "320x200", "frames": 7, "warm_up": 0, "reference": {"bounces": 8, "samples": 32, "error": 0}})",
                                  "sweep");
    REQUIRE_MESSAGE(sweep, sweep.error().message);
    const Setting& setting = sweep->settings[0];
    CHECK(setting.technique->name == "screen_indirect");
    CHECK(setting.configured.settings ==
          Json::parse(R"({"preset": "quarter-64", "start": "full", "levels": 3, "samples_per_level": 8,
                          "ring_radius_texels": 12.5, "reduction": "nearest", "form_factor": "point",
                          "minimum_cosine": 0.25, "cover_screen": false, "smooth": false, "only_level": null})"));
    const Plan& plan = setting.configured.plan;
    CHECK(plan.resources[size_t(plan.find("depth"))].extent == Extent2D{320, 200});
    CHECK(sweep->settings[0].name == "full-8-3 nearest form factor point radius 12.5 minimum cosine 0.25 "
                                     "not covering not smoothed");
    CHECK(sweep->settings[1].configured.settings.at("ring_radius_texels") ==
          coveringRingRadius(*screenIndirectPreset("quarter-64", {320, 200})));
    CHECK(sweep->backends == std::vector<std::string>{"scalar", "cpu"});
    REQUIRE(sweep->scenes.size() == 2);
    CHECK(sweep->scenes[1].viewFile == "night.json");
    CHECK(sweep->scenes[1].cameras.size() == 2);
    CHECK(sweep->frames == 7);
    CHECK(sweep->warmUp == 0);
    CHECK(sweep->reference.bounces == 8);
    CHECK(sweep->reference.samples == 32);
    CHECK(sweep->reference.error == 0.0);
}

TEST_CASE("another size replaces the file's, and rings follow it") {
    const auto sweep = parseSweep(R"({"techniques": {"screen_indirect": [{}]}, "size": "64x36"})", "sweep",
                                  Extent2D{1280, 720});
    REQUIRE(sweep);
    CHECK(sweep->size == Extent2D{1280, 720});
    CHECK(sweep->settings[0].configured.settings.at("ring_radius_texels") == 40.0f);
}

TEST_CASE("the default sweep has all presets, 16 to 256 samples, both starts and both reductions") {
    const auto sweep = parseSweep(defaultSweepText(), "the default sweep");
    REQUIRE_MESSAGE(sweep, sweep.error().message);
    const std::set<std::string> names = namesOf(*sweep);
    for (const std::string_view preset : screenIndirectPresetNames())
        CHECK(names.contains(std::string(preset)));
    for (const char* start : {"half-", "quarter-"})
        for (const char* samples : {"16", "32", "64", "128", "256"})
            for (const char* reduction : {"", " nearest"})
                CHECK(names.contains(std::string(start) + samples + reduction));
    CHECK(names.size() == 24);
    CHECK(sweep->scenes.size() == 2);
}

struct BadSweep {
    std::string text;
    std::initializer_list<const char*> says;
};

std::string withSetting(const std::string& setting) {
    return R"({"techniques": {"screen_indirect": [{"levels": 4}, {)" + setting + "}]}}";
}
std::string withKey(const std::string& key) {
    return R"({"techniques": {"screen_indirect": [{}]}, )" + key + "}";
}

TEST_CASE("unknown keys and impossible values are refused with file, key, value and what was expected") {
    const BadSweep all[] = {
        {"", {"it is not a sweep"}},
        {"[]", {"not an object"}},
        {"{}", {"techniques is missing"}},
        {R"({"techniques": {}})", {"techniques is {}", "screen_indirect"}},
        {R"({"techniques": []})", {"techniques is []", "an object"}},
        {R"({"techniques": {"path_tracing": []}})", {"path_tracing", "screen_indirect"}},
        {R"({"techniques": {"screen_indirect": []}})", {"techniques.screen_indirect is []", "not empty"}},
        {R"({"techniques": {"screen_indirect": [5]}})", {"techniques.screen_indirect[0] is 5", "an object"}},
        {withSetting(R"("leves": 3)"), {"screen_indirect[1]", "\"leves\"", "levels"}},
        {withSetting(R"("levels": 9)"), {"screen_indirect[1].levels is 9", "1 to 8"}},
        {withSetting(R"("levels": [3, 0])"), {"levels is 0", "1 to 8"}},
        {withSetting(R"("levels": 2.5)"), {"levels is \"2.5\"", "whole"}},
        {withSetting(R"("levels": 1e300)"), {"levels", "whole"}},
        {withSetting(R"("levels": [])"), {"levels is []"}},
        {withSetting(R"("levels": [[1]])"), {"levels is [1]"}},
        {withSetting(R"("samples": 257)"), {"samples is \"257\"", "4 to 256"}},
        {withSetting(R"("samples": "many")"), {"samples is \"many\"", "all"}},
        {withSetting(R"("preset": "fast")"), {"preset is \"fast\"", "quarter-64"}},
        {withSetting(R"("preset": 4)"), {"preset is \"4\"", "quarter-64"}},
        {withSetting(R"("preset": true)"), {"preset is true", "a text or a number"}},
        {withSetting(R"("only_level": 1)"), {"screen_indirect[1]", "\"only_level\"", "levels"}},
        {withSetting(R"("start": "third")"), {"start is \"third\"", "half"}},
        {withSetting(R"("reduce": "sum")"), {"reduce is \"sum\"", "voting"}},
        {withSetting(R"("form_factor": "ring")"), {"form_factor is \"ring\"", "disc"}},
        {withSetting(R"("radius": 0)"), {"radius is 0", "1 to 1024"}},
        {withSetting(R"("radius": "wide")"), {"radius is \"wide\"", "auto"}},
        {withSetting(R"("minimum_cosine": 2)"), {"minimum_cosine is 2", "0.001 to 1"}},
        {withKey(R"("size": "4x")"), {"size is \"4x\"", "WIDTHxHEIGHT"}},
        {withKey(R"("size": 4)"), {"size is 4"}},
        {withKey(R"("frames": 0)"), {"frames is 0", "1 to 100000"}},
        {withKey(R"("frames": "many")"), {"frames is \"many\""}},
        {withKey(R"("warm_up": -1)"), {"warm_up is -1", "0 to 100000"}},
        {withKey(R"("backends": "cpu")"), {"backends is \"cpu\"", "array"}},
        {withKey(R"("scenes": [{"file": "x"}])"), {"scenes[0]", "\"file\"", "cameras"}},
        {withKey(R"("scenes": [{}])"), {"scenes[0].scene is missing"}},
        {withKey(R"("scenes": [""])"), {"scenes[0] is \"\""}},
        {withKey(R"("reference": {"paths": 1})"), {"reference", "\"paths\"", "samples"}},
        {withKey(R"("reference": {"bounces": 0})"), {"reference.bounces is 0", "1 to 64"}},
        {withKey(R"("reference": {"samples": 0})"), {"reference.samples is 0"}},
        {withKey(R"("reference": {"error": -0.1})"), {"reference.error is -0.1", "0 to 1"}},
        {withKey(R"("frame": 3)"), {"\"frame\"", "frames"}},
    };
    for (const BadSweep& bad : all) {
        INFO("sweep: ", bad.text);
        const auto sweep = parseSweep(bad.text, "bad.json");
        REQUIRE(!sweep);
        const std::string& message = sweep.error().message;
        INFO("it says: ", message);
        CHECK(message.starts_with("'bad.json': "));
        CHECK(message.find('\n') == std::string::npos);
        for (const char* text : bad.says) CHECK(message.find(text) != std::string::npos);
    }
}

TEST_CASE("a sweep that would never end is refused") {
    std::string samples = "[4";
    for (int i = 5; i <= 256; ++i) samples += "," + std::to_string(i);
    const auto sweep =
        parseSweep(withSetting("\"samples\": " + samples + "], \"radius\": " + samples + "]"), "bad.json");
    REQUIRE(!sweep);
    CHECK(sweep.error().message.find("10000 combinations") != std::string::npos);
}

TEST_CASE("a sweep comes from a file, and a missing one is named") {
    const lab::TemporaryFolder folder;
    lab::writeText(folder / "sweep.json", std::string(defaultSweepText()));
    CHECK(readSweep(folder / "sweep.json"));
    const auto missing = readSweep(folder / "missing.json");
    REQUIRE(!missing);
    CHECK(missing.error().message.find("missing.json") != std::string::npos);
}

} // namespace
} // namespace rebound::charts
