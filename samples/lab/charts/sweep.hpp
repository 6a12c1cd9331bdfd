// SPDX-License-Identifier: MIT
// What a chart measures: techniques x settings x backends over scenes, as a JSON file says it.
#pragma once

#include "lab/techniques/technique.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rebound::charts {

using techniques::Json;

struct Setting {
    const techniques::Technique* technique;
    techniques::Draft draft;
    techniques::Configured configured; // at the sweep's size, for a perspective camera
    std::string
        name; // from what it does: half-64, quarter-64-5 nearest; where a sweep has several techniques, after
              // the technique's; unique in a sweep

    // For that camera.
    Result<techniques::Configured> forCamera(const lab::CameraView&, Extent2D size) const;
};

struct SceneChoice {
    std::string scene;                // a glTF file, or a built-in scene's name
    std::string viewFile;             // empty: view.json beside the scene, where there is one
    std::vector<std::string> cameras; // empty: all
};

struct ReferenceChoice {
    int bounces = 1;     // surfaces that light meets in between, 1 to 64
    int samples = 128;   // paths a pixel at most, 1 to 2^20
    double error = 0.02; // relative; tracing ends where it is reached, 0 to 1
};

struct Sweep {
    std::vector<Setting> settings;
    std::vector<std::string> backends = {"cpu"};
    std::vector<SceneChoice> scenes = {{"builtin:atrium", "", {}}, {"builtin:cornell", "", {}}};
    Extent2D size{640, 360};
    int frames = 20; // measured for each point, 1 to 100000
    int warmUp = 3;  // before them, 0 to 100000
    ReferenceChoice reference;
};

// The text of such a file; `name` is what errors call it. An array in a setting means each of its values, with each of
// all others'. Settings that come to the same are taken once. `size` replaces the text's.
Result<Sweep> parseSweep(std::string_view text, const std::string& name, std::optional<Extent2D> size = {});
Result<Sweep> readSweep(const std::filesystem::path&, std::optional<Extent2D> size = {});

// What is measured where there is no file.
std::string_view defaultSweepText();

// As run, with what was left out.
Json toJson(const Sweep&);
Json toJson(const ReferenceChoice&);

} // namespace rebound::charts
