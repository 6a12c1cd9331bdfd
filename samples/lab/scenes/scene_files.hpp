// SPDX-License-Identifier: MIT
// Scenes from files and from code.
#pragma once

#include "lab/scenes/scene.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rebound::lab {

struct GltfOptions {
    std::string animation; // a clip's name; empty: the first, if there is one
    float time = 0.0f;     // of that clip [s]; past its end it holds the last pose
    bool animate = false;  // false: the file's rest pose
    // Of nodes by name: where each is and what is below it, by a transform in world space on top of the pose.
    std::map<std::string, glm::mat4> moved = {};
};

// Reads .gltf or .glb (2.0): node transforms, base colour with textures and alpha mask, emission with
// KHR_materials_emissive_strength, KHR_lights_punctual, cameras, skins and animations. Triangle primitives
// (lists, strips, fans); other primitives are skipped. Normals are generated where a file has none.
// Photometric units of KHR_lights_punctual (lux, candela) are taken as radiometric ones.
Result<Scene> loadGltf(const std::filesystem::path&, const GltfOptions& = {});

// Applies a view file (cameras, lights, environment; a JSON object whose key "units" says the units) to a scene that
// it describes: its cameras replace the scene's, and its lights too.
Result<> applyViewFile(const std::filesystem::path&, Scene&);

// What a view file says about the moment to load; read before the scene it belongs to.
Result<GltfOptions> readViewAnimation(const std::filesystem::path&);

// The moment of a moving scene; what is absent is the view file's, or else the first clip at 0 s. With neither of them,
// and no animation in the view file, the scene rests.
struct SceneMoment {
    std::optional<std::string> animation; // a clip's name
    std::optional<float> time;            // of that clip [s]
    // Of glTF nodes, or of a built-in scene's meshes, by name: a transform in world space on top of that.
    std::map<std::string, glm::mat4> moved = {};
};

// A scene file, or one of builtinScenes(), which have no animation. With an empty viewFile, the view.json
// beside a scene file is used where there is one. A scene that has no camera gets one that sees all of it. The result
// is validated.
Result<Scene> loadScene(const std::string& fileOrBuiltin, const std::filesystem::path& viewFile = {},
                        const SceneMoment& = {});

Scene makeCornellBox();
Scene makeAtrium();
Scene makeStudy();
Scene makeStreet();
Scene makeTunnel();

// Names of the scenes made in code, with "builtin:" before them.
const std::vector<std::string>& builtinScenes();
// The same as a sentence has them: "a, b or c".
std::string builtinSceneList();

} // namespace rebound::lab
