// SPDX-License-Identifier: MIT
// What the commands share on the command line, and what it means.
#pragma once

#include "lab/measure/run_values.hpp"
#include "lab/techniques/technique.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rebound::cli {

// Where the picture comes from: a scene, or a stored frame.
struct SourceOptions {
    std::string scene = "builtin:atrium"; // a glTF file or a built-in scene's name
    std::string frame;                    // a folder; empty: the scene
    std::string view;                     // a view file; empty: view.json beside the scene
    std::string camera;                   // empty: the first
    std::optional<std::string> animation; // a clip's name
    std::optional<float> time;            // of the clip [s]
    int lightSamples = 16;                // shadow rays a pixel for each light that is not a point
};

// A technique and its settings as they were written.
struct TechniqueOptions {
    std::string name = techniques::all().front().name;
    techniques::Draft draft;
    std::string size = "1280x720";
};

struct DeviceChoice {
    std::string backend = "cpu";
    std::string device; // of vulkan and opengl: part of its name
    std::string isa = "automatic";
    int threads = 0; // 0: one a core
    std::string precision = "half";
};

// Headings of --help.
inline constexpr const char* sourceGroup = "Scene";
inline constexpr const char* techniqueGroup = "Technique";
inline constexpr const char* referenceGroup = "Path-traced reference";
inline constexpr const char* deviceGroup = "Device";

// A scene and a camera of it.
void addSceneOptions(CLI::App&, SourceOptions&);
// The same, or a stored frame.
void addSourceOptions(CLI::App&, SourceOptions&);
// --technique, --size and the options of every technique.
void addTechniqueOptions(CLI::App&, TechniqueOptions&);
// That, without options that are no settings.
void addTechniqueSettings(CLI::App&, TechniqueOptions&);
void addDeviceOptions(CLI::App&, DeviceChoice&);
// To be called after the three above: those that say what a scene looks like contradict --frame.
void excludeSceneOptionsFromFrames(CLI::App&);

// What stands between commas.
std::vector<std::string> splitList(const std::string&);

// WIDTHxHEIGHT, each 1 to maximumExtent.
Result<Extent2D> parseSize(const std::string&);

// The technique that was asked for. Fails where there is no such technique, or an option was given that is another's.
Result<const techniques::Technique*> techniqueOf(const TechniqueOptions&);

// That technique with its settings, for such pictures; their size replaces --size.
Result<techniques::Configured> configure(const TechniqueOptions&, const techniques::View&);

// A backend whose passes are measured.
Result<std::unique_ptr<runner::Backend>> createBackend(const DeviceChoice&);
Result<runner::Precision> precisionOf(const DeviceChoice&);

// What can be said about options before anything long begins.
struct Preparation {
    std::unique_ptr<runner::Backend> backend;
    runner::Precision precision;
    Extent2D extent; // of scenes
};
Result<Preparation> prepare(const TechniqueOptions&, const DeviceChoice&);

using measure::nameOf;
using techniques::Json;

} // namespace rebound::cli
