// SPDX-License-Identifier: MIT
// What backends are held against each other with: plans and inputs, every one made anew from its name and seed.
#pragma once

#include "lab/conformance/tolerances.hpp"
#include "lab/runner/runner.hpp"
#include "lab/scenes/scene_files.hpp"
#include "lab/techniques/technique.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rebound::conformance {

struct Case {
    Plan plan;
    runner::PlanInputs inputs;
    runner::Precision precision = runner::Precision::half;
    std::vector<ImageTolerance> tolerances; // by resource of the plan
    std::vector<runner::PlanInputs> later =
        {}; // of the frames behind the first: what plans with history are run for
};

struct NamedCase {
    std::string name;
    std::function<Result<Case>()> make;
};

// Of screen-space indirect light: random settings, conventions and G-buffers, planes in patches with sky between them.
std::vector<NamedCase> randomCases(int count, uint64_t seed);
// Of screen-space indirect light: sizes, scales and values at the ends of what is allowed, and beyond.
std::vector<NamedCase> hardCases();

struct SceneCases {
    std::vector<std::string> scenes = lab::builtinScenes();
    Extent2D extent{320, 180};
};
// First views of scenes under the examples of a technique, and the Cornell box at sizes of 0.1 m and 10 km.
std::vector<NamedCase> sceneCases(const SceneCases& = {},
                                  const techniques::Technique& = techniques::all().front());

} // namespace rebound::conformance
