// SPDX-License-Identifier: MIT
// The options' names and help, apart from their meaning.
#include "options.hpp"

#include <CLI/CLI.hpp>

namespace rebound::cli {

void addSceneOptions(CLI::App& app, SourceOptions& o) {
    app.add_option("scene", o.scene,
                   "a glTF 2.0 file (.gltf, .glb), or builtin:atrium or builtin:cornell\n"
                   "(default: builtin:atrium)")
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

void addTechniqueOptions(CLI::App& app, TechniqueOptions& o) {
    app.add_option("--size", o.size, "of the pictures [pixels], each side 1 to 16384 (default: 1280x720)")
        ->option_text("WxH")
        ->group(techniqueGroup);
    app.add_option("--preset", o.preset,
                   "quarter-64, quarter-256, half-64, half-256: where gathering starts, and\n"
                   "samples a level; each also with -5, for five levels instead of four.\n"
                   "The options below replace its values (default: quarter-64)")
        ->option_text("NAME")
        ->group(techniqueGroup);
    app.add_option("--start", o.start,
                   "resolution where gathering starts: full, half or quarter of each side")
        ->option_text("WHERE")
        ->group(techniqueGroup);
    app.add_option("--levels", o.levels, "levels, each half as fine as the one before, 1 to 8")
        ->option_text("N")
        ->group(techniqueGroup);
    app.add_option("--radius", o.radius,
                   "outer radius of every ring [texels of its level], 1 to 1024; auto: the\n"
                   "smallest with which the outermost ring covers the screen\n"
                   "(presets: 40 at 720 rows, in proportion elsewhere)")
        ->option_text("R")
        ->group(techniqueGroup);
    app.add_option("--samples", o.samples,
                   "samples a texel of level 0, 4 to 256, on each coarser level half as many\nagain; all: "
                   "every texel of every ring")
        ->option_text("N")
        ->group(techniqueGroup);
    app.add_option("--reduce", o.reduction,
                   "which texel lends a coarser one its place and normal: nearest to the eye,\n"
                   "or by voting (presets: voting)")
        ->option_text("HOW")
        ->group(techniqueGroup);
    app.add_option("--form-factor", o.formFactor,
                   "between disc and point, bounded; or between points, unbounded, for\n"
                   "comparison: disc or point (presets: disc)")
        ->option_text("WHICH")
        ->group(techniqueGroup);
    app.add_option("--minimum-cosine", o.minimumCosine,
                   "a pixel's area is taken as if seen at no less, 0.001 to 1 (presets: 0.05)")
        ->option_text("C")
        ->group(techniqueGroup);
    app.add_option(
           "--cover-screen", o.coverScreen,
           "the outermost ring reaches the screen's corners, or ends at its radius: on or off\n(presets: on)")
        ->option_text("SWITCH")
        ->group(techniqueGroup);
    app.add_option(
           "--smooth", o.smooth,
           "four sample patterns a level and a 5x5 mean over them, or one pattern:\non or off (presets: on)")
        ->option_text("SWITCH")
        ->group(techniqueGroup);
    app.add_option("--only-level", o.onlyLevel,
                   "show what this level alone contributes, 0 to levels - 1 (default: all)")
        ->option_text("K")
        ->group(techniqueGroup);
}

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
