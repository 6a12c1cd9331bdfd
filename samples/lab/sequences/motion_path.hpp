// SPDX-License-Identifier: MIT
// How a camera and objects move: keys at times, and what lies between them.
#pragma once

#include "lab/scenes/scene.hpp"
#include "rebound/result.hpp"

#include <glm/glm.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rebound::lab {

enum class Interpolation {
    smooth, // cubic Hermite splines whose slope at a key is that between its neighbours (Catmull-Rom, for keys at any times)
    linear,
};

struct CameraKey {
    double time = 0.0; // [s]
    glm::vec3 position{0.0f};
    glm::vec3 target{0, 0, -1};
    std::optional<float> fieldOfView; // full vertical angle [rad]; absent in all keys: the camera's own
};

// A rotation about an axis through a pivot, then a translation, both of where the object rests in the world.
struct ObjectKey {
    double time = 0.0; // [s]
    glm::vec3 translation{0.0f};
    float degrees = 0.0f;
};

struct ObjectPath {
    std::string name; // of a glTF node, which takes its descendants along, or of a built-in scene's meshes
    glm::vec3 pivot{0.0f};
    glm::vec3 axis{0, 1, 0}; // any length but zero
    std::vector<ObjectKey> keys;
};

// Before its first key and after its last, everything stands still.
struct MotionPath {
    Interpolation interpolation = Interpolation::smooth;
    std::vector<CameraKey> camera; // empty: the camera stands still
    std::vector<ObjectPath> objects;
};

// A file's text, as docs/command_line.md describes it; `name` is what errors call it. Times have to rise from key to key.
Result<MotionPath> parsePath(std::string_view text, const std::string& name);
Result<MotionPath> readPath(const std::filesystem::path&);

// Of a scene made in code, "builtin:" included; nothing for others.
std::optional<MotionPath> builtinPath(const std::string& scene);

// The given camera with what the path says of it at that time.
CameraView cameraAt(const MotionPath&, const CameraView&, double time);
// From where the object rests to where it is.
glm::mat4 placeAt(const MotionPath&, const ObjectPath&, double time);

} // namespace rebound::lab
