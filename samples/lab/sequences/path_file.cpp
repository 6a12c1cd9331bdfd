// SPDX-License-Identifier: MIT
// Paths as JSON.
#include "lab/files/file_bytes.hpp"
#include "lab/files/json_reader.hpp"
#include "lab/files/json_text.hpp"
#include "lab/rays/camera_rays.hpp"
#include "lab/sequences/motion_path.hpp"

#include <cmath>
#include <limits>

namespace rebound::lab {

namespace {

using Value = nlohmann::json;

constexpr size_t largestPathFile = size_t(1) << 24; // [bytes]
constexpr double longest = 1e5;                     // [s]
constexpr double farthest = 1e9;                    // [m]
constexpr double mostDegrees = 1e7;

// Keys in an array, whose times rise.
template <class Key, class ReadKey>
std::vector<Key> readKeys(const Value& list, const std::string& where, const ReadKey& readKey) {
    std::vector<Key> keys;
    double last = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < arrayOf(list, where).size(); ++i) {
        const std::string place = where + "[" + std::to_string(i) + "]";
        if (!list[i].is_object()) refuseValue(place, list[i], "an object");
        Key key = readKey(list[i], place);
        key.time =
            numberOf(member(list[i], "time_s", place + ".time_s"), place + ".time_s", -longest, longest);
        if (!(key.time > last))
            refuseValue(place + ".time_s", list[i]["time_s"],
                        "a time after the key before, " + shortText(Value(last)) + " s,");
        last = key.time;
        keys.push_back(key);
    }
    return keys;
}

CameraKey readCameraKey(const Value& object, const std::string& where) {
    checkKeys(object, where, {"time_s", "position", "target", "vfov_degrees"});
    CameraKey key;
    key.position = vectorOf(member(object, "position", where + ".position"), where + ".position", farthest);
    key.target = vectorOf(member(object, "target", where + ".target"), where + ".target", farthest);
    if (object.contains("vfov_degrees"))
        key.fieldOfView =
            glm::radians(float(numberOf(object["vfov_degrees"], where + ".vfov_degrees", 0.1, 179.0)));
    CameraView camera;
    camera.position = key.position;
    camera.target = key.target;
    if (const auto valid = validate(camera); !valid) refuse(where + ": " + valid.error().message);
    return key;
}

ObjectKey readObjectKey(const Value& object, const std::string& where) {
    checkKeys(object, where, {"time_s", "translation", "degrees"});
    ObjectKey key;
    if (object.contains("translation"))
        key.translation = vectorOf(object["translation"], where + ".translation", farthest);
    if (object.contains("degrees"))
        key.degrees = float(numberOf(object["degrees"], where + ".degrees", -mostDegrees, mostDegrees));
    return key;
}

ObjectPath readObject(const std::string& name, const Value& object) {
    const std::string where = "objects." + name;
    checkKeys(object, where, {"pivot", "axis", "keys"});
    ObjectPath path;
    path.name = name;
    if (object.contains("pivot")) path.pivot = vectorOf(object["pivot"], where + ".pivot", farthest);
    if (object.contains("axis")) path.axis = vectorOf(object["axis"], where + ".axis", farthest);
    if (!(glm::length(path.axis) > 0.0f))
        refuseValue(where + ".axis", object["axis"], "a vector that is not zero");
    path.keys = readKeys<ObjectKey>(member(object, "keys", where + ".keys"), where + ".keys", readObjectKey);
    return path;
}

MotionPath readPathObject(const Value& root) {
    checkKeys(root, "", {"interpolation", "camera", "objects"});
    MotionPath path;
    if (root.contains("interpolation")) {
        const std::string how = textOf(root["interpolation"], "interpolation");
        if (how != "smooth" && how != "linear")
            refuseValue("interpolation", root["interpolation"], "\"smooth\" or \"linear\"");
        path.interpolation = how == "linear" ? Interpolation::linear : Interpolation::smooth;
    }
    if (root.contains("camera")) path.camera = readKeys<CameraKey>(root["camera"], "camera", readCameraKey);
    if (root.contains("objects")) {
        if (!root["objects"].is_object()) refuseValue("objects", root["objects"], "an object");
        for (const auto& [name, object] : root["objects"].items())
            path.objects.push_back(readObject(name, object));
    }
    if (path.camera.empty() && path.objects.empty())
        refuse("it moves nothing: \"camera\" or \"objects\" was expected");
    return path;
}

} // namespace

Result<MotionPath> parsePath(std::string_view text, const std::string& name) {
    return guardInput(name, [&] { return readPathObject(parseJsonObject(text, "a path")); });
}

Result<MotionPath> readPath(const std::filesystem::path& file) {
    return guardInput(file, [&] {
        const std::vector<uint8_t> bytes = readFileBytes(file, largestPathFile, file);
        return readPathObject(
            parseJsonObject({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "a path"));
    });
}

} // namespace rebound::lab
