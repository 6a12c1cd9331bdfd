// SPDX-License-Identifier: MIT
// A technique as a value: all that render, bench, plan, chart, explain and conform have to know of it. Another one is a
// file in this folder that makes such a value, and a line in registry.cpp.
#pragma once

#include "lab/baking/lit_bake.hpp"
#include "lab/rays/frame.hpp"
#include "lab/runner/runner.hpp"
#include "rebound/camera.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rebound::techniques {

// Keeps the order in which keys were added.
using Json = nlohmann::ordered_json;

// Settings as people wrote them, by option, such as {"form-factor", "disc"}. What is absent is the technique's default.
using Draft = std::map<std::string, std::string>;

// How errors call a setting: --form-factor on a command line, form_factor in a file.
enum class Spelling { options, keys };
std::string spelled(const std::string& option, Spelling);

// What has to be known of pictures before they can be planned for.
struct View {
    Extent2D size; // [pixels]
    Projection projection = Projection::perspective;
};
View viewOf(const lab::Frame&);

struct Option {
    std::string name;        // without dashes
    std::string placeholder; // of its value, in help
    std::string help;
    bool isSetting = true; // false: a look inside, which neither sweeps nor explain take
};

// Where pictures are taken, for techniques that know more than the picture.
struct Surroundings {
    std::shared_ptr<const lab::Scene> scene;
    int threads = 0; // 0: one a core
    // What is being done, and the share of it that is, 0 to 1.
    std::function<void(std::string_view, double)> progress = {};
};

// A technique with all of its settings, for pictures of one size.
struct Configured {
    Json settings;    // as run: of files of results
    std::string name; // what the settings do, in few words: equal where, and only where, they do the same
    std::string description; // the same for people, a line without its end
    // Its output "indirect" is E / pi of indirect light, albedo not in it [W m^-2 sr^-1]; "composed", where it has that,
    // is outgoing radiance + albedo * indirect.
    Plan plan;
    // A frame as the plan takes it; sent: radiance that lights other surfaces, lit: the picture that indirect light is
    // added to, both up to what half precision holds. Where the frame goes on from another, its motion says how.
    std::function<Result<runner::PlanInputs>(const lab::Frame&, const lab::Image& sent,
                                             const lab::Image& lit)>
        inputs;
    // Frames until the picture of what stands still is what it stays.
    int settlingFrames = 1;
    // Of a technique that needs the scene, which completed() is then given: the plan above is only about as large as the
    // real one, and there are no inputs. Else empty.
    std::function<Result<Configured>(const Surroundings&)> inScene = {};
    std::vector<std::string> notes = {};           // what was done to get there: sentences
    std::shared_ptr<const lab::LitBake> bake = {}; // of a technique that has one, in its scene
};

// What can be run. Fails where the technique needs the scene, and there is none; `what` is what errors call the pictures.
Result<Configured> completed(Configured, const Surroundings&, const std::string& what);

// One of a technique's own approximations, switched to truth on top of those before it.
struct Ablation {
    std::string name;
    std::string meaning; // what was switched from what to what
    Configured without;
};

// What remains after a technique's ablations: the step to the exact integral over what the screen shows.
struct LastApproximation {
    std::string name = "method";
    std::string meaning = "the technique -> the exact integral over what the screen shows";
};

struct Technique {
    std::string name;    // such as screen_indirect
    std::string heading; // above its options, in help
    std::vector<Option> options;
    // Fails where a value is none of an option's, or the settings are out of range; the error names the option.
    std::function<Result<Configured>(const Draft&, const View&, Spelling)> parse;
    // Optional, for explain: in the order in which they are switched.
    std::function<Result<std::vector<Ablation>>(const Draft&, const View&)> ablations;
    LastApproximation lastApproximation;
    std::vector<Draft> examples; // what conform runs on the lab's scenes; at least one
};

// All that there are; the first is the default.
const std::vector<Technique>& all();

// Names with commas between them.
std::string names();

// `what` is what errors call the name.
Result<const Technique*> named(const std::string& what, const std::string& name);

// Fails where the draft has an option that the technique does not have.
Result<> checkOptions(const Technique&, const Draft&, Spelling);

} // namespace rebound::techniques
