// SPDX-License-Identifier: MIT
// The engines' command line, and what they print.
#pragma once

#include "lab/images/image.hpp"
#include "lab/scenes/scene.hpp"
#include "rebound/bake/bake.hpp"
#include "rebound/device.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace rebound::engine {

struct Options {
    std::string scene = "builtin:atrium", view, camera, preset = "quarter-64", out, device;
    std::string
        bake; // of the scene: light is composed from it, and a ball and lights move; empty: screen-space light
    Extent2D size{1280, 720};
    std::optional<int> frames; // absent: 2, or in a window as many as it takes until it is closed
    bool validation = false;
    bool window = false;
};

// What differs from engine to engine.
struct ProgramText {
    std::string name, description, out; // out: the picture's name by default
    std::string device, validation;     // what these options do
    bool window = false;                // whether it can show one
};

// Parses, loads the scene, and hands it on. Returns the program's exit code: 0, or 2 with one sentence on standard error.
int runProgram(int argc, char** argv, const ProgramText&,
               const std::function<Result<>(const Options&, const lab::Scene&, const lab::CameraView&)>&);

// Reads the bake that the options name. Fails where the build cannot read bakes.
Result<Bake> bakeOf(const Options&);

// Writes the picture, row 0 on top, and says what it took.
Result<> writePicture(const Options&, const std::string& scene, const std::string& device,
                      const lab::Image& composed, std::span<const PassTiming>, const MemoryUse&);

} // namespace rebound::engine
