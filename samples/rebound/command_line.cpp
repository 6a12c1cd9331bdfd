// SPDX-License-Identifier: MIT
// The options' names and help, apart from their meaning.
#include "lab/scenes/scene_files.hpp"
#include "options.hpp"

#include <CLI/CLI.hpp>

namespace rebound::cli {

void addSceneOptions(CLI::App& app, SourceOptions& o) {
    app.add_option("scene", o.scene,
                   "a glTF 2.0 file (.gltf, .glb), or\n" + lab::builtinSceneList() +
                       "\n(default: builtin:atrium)")
        ->option_text("SCENE")
        ->group(sourceGroup);
    app.add_option("--view", o.view,
                   "a view file: cameras, lights, environment, animation\n"
                   "(default: view.json beside the scene, where there is one)")
        ->option_text("FILE")
        ->group(sourceGroup);
    app.add_option("--camera", o.camera, "a camera's name (default: the first)")
        ->option_text("NAME")
        ->group(sourceGroup);
    app.add_option("--animation", o.animation, "a clip's name (default: the view file's, or else the first)")
        ->option_text("NAME")
        ->group(sourceGroup);
    app.add_option("--time", o.time,
                   "moment of that clip [s]; past its end it holds the last pose\n"
                   "(default: the view file's, or else the rest pose; 0 with --animation)")
        ->option_text("SECONDS")
        ->group(sourceGroup);
}

void addSourceOptions(CLI::App& app, SourceOptions& o) {
    addSceneOptions(app, o);
    app.add_option("--frame", o.frame,
                   "instead of a scene, a folder that holds depth.exr, normal.exr,\n"
                   "albedo.exr, direct.exr, emission.exr (optional) and meta.json, whose\n"
                   "\"camera\" took them; its size is the pictures' size")
        ->option_text("DIR")
        ->group(sourceGroup);
    app.add_option("--light-samples", o.lightSamples,
                   "shadow rays a pixel for each area light, for emissive surfaces and for\n"
                   "the environment, 1 to 65536 (default: 16)")
        ->option_text("N")
        ->check(CLI::Range(1, 65536))
        ->group(sourceGroup);
}

namespace {

// Of techniques that have an option of the same name, the first describes it.
void addOptionsOf(CLI::App& app, const techniques::Technique& technique, TechniqueOptions& o,
                  bool settingsOnly) {
    for (const techniques::Option& option : technique.options)
        if ((option.isSetting || !settingsOnly) && !app.get_option_no_throw("--" + option.name))
            app.add_option_function<std::string>(
                   "--" + option.name,
                   [&o, name = option.name](const std::string& value) { o.draft[name] = value; }, option.help)
                ->option_text(option.placeholder)
                ->group(technique.heading);
}

void addTechnique(CLI::App& app, TechniqueOptions& o, bool settingsOnly) {
    if (!app.get_option_no_throw("--technique"))
        app.add_option("--technique", o.name, "one of " + techniques::names() + " (default: " + o.name + ")")
            ->option_text("NAME")
            ->group(techniqueGroup);
    app.add_option("--size", o.size, "of the pictures [pixels], each side 1 to 16384 (default: 1280x720)")
        ->option_text("WxH")
        ->group(techniqueGroup);
    for (const techniques::Technique& technique : techniques::all())
        addOptionsOf(app, technique, o, settingsOnly);
}

} // namespace

void addTechniqueOptions(CLI::App& app, TechniqueOptions& o) { addTechnique(app, o, false); }
void addTechniqueSettings(CLI::App& app, TechniqueOptions& o) { addTechnique(app, o, true); }

void addDeviceOptions(CLI::App& app, DeviceChoice& o) {
    app.add_option("--backend", o.backend, "what the technique runs on: cpu, vulkan or opengl (default: cpu)")
        ->option_text("NAME")
        ->group(deviceGroup);
    app.add_option("--device", o.device,
                   "of vulkan and opengl: part of the device's name (default: a GPU before\n"
                   "a driver in software)")
        ->option_text("NAME")
        ->group(deviceGroup);
    app.add_option("--isa", o.isa,
                   "instruction set of the CPU: scalar, baseline, avx2 or avx512; automatic: the best\n"
                   "that this processor runs (default: automatic)")
        ->option_text("NAME")
        ->group(deviceGroup);
    app.add_option("--threads", o.threads,
                   "1 to 1024; 0: one a core (default: 0). Results do not depend on it")
        ->option_text("N")
        ->group(deviceGroup);
    app.add_option("--precision", o.precision,
                   "how the host keeps colours and normals, a plane a channel: half, as\n"
                   "engines do, or float. Depth is always float (default: half)")
        ->option_text("P")
        ->group(deviceGroup);
}

void excludeSceneOptionsFromFrames(CLI::App& app) {
    CLI::Option* frame = app.get_option("--frame");
    for (const char* name : {"scene", "--size", "--animation", "--time", "--light-samples"})
        frame->excludes(app.get_option(name));
}

} // namespace rebound::cli
