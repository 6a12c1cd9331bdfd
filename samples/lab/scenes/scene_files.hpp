// SPDX-License-Identifier: MIT
// Scenes from files and from code.
#pragma once

#include "lab/scenes/scene.hpp"

#include <filesystem>
#include <map>
#include <memory>
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

// A view file: a JSON object whose key "units" says the units. What it does not hold is absent.
struct ViewFile {
    std::optional<std::vector<CameraView>> cameras;
    std::optional<std::vector<Light>> lights;
    std::optional<glm::vec3> environment;
    std::optional<bool> emissiveMaterialsLight;
    GltfOptions animation;          // the moment to load; at rest if the file does not say
    std::vector<std::string> notes; // keys that it does not know: sentences
};
Result<ViewFile> readViewFile(const std::filesystem::path&);

// What the view file holds replaces the scene's, what it does not hold stays; its notes are added to the scene's.
void applyViewFile(const ViewFile&, Scene&);

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

// The same for many moments: files are read and pictures decoded once.
class MovingScene {
public:
    static Result<MovingScene> open(const std::string& fileOrBuiltin,
                                    const std::filesystem::path& viewFile = {});
    MovingScene(MovingScene&&) noexcept;
    MovingScene& operator=(MovingScene&&) noexcept;
    ~MovingScene();

    // What loadScene() gives for that moment.
    Result<Scene> at(const SceneMoment&) &;
    // The last one, which takes the textures along.
    Result<Scene> at(const SceneMoment&) &&;

private:
    struct Source;
    explicit MovingScene(std::unique_ptr<Source>);
    std::unique_ptr<Source> source;
};

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
