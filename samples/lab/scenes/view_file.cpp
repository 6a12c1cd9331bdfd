// SPDX-License-Identifier: MIT
#include "lab/scenes/scene_files.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/files/input_error.hpp"
#include "lab/files/json_text.hpp"
#include "lab/scenes/camera_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace rebound::lab {
namespace {

using Json = nlohmann::json;

constexpr size_t largestViewFile = size_t(1) << 24; // [bytes]

Json readJson(const std::filesystem::path& file) {
    const std::vector<uint8_t> bytes = readFileBytes(file, largestViewFile, file);
    return parseJsonObject({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "a view file");
}

const Json& member(const Json& object, const char* key, const std::string& subject) {
    const auto found = object.find(key);
    if (found == object.end()) refuse(subject + " lacks the key '" + key + "'");
    return *found;
}

[[noreturn]] void refuseValue(const std::string& subject, const char* key, const Json& value,
                              const std::string& expected) {
    refuse(subject + " has the key '" + key + "' as " + shown(value) + "; expected " + expected);
}

std::string text(const Json& object, const char* key, const std::string& subject) {
    const Json& value = member(object, key, subject);
    if (!value.is_string()) refuseValue(subject, key, value, "a string");
    return value.get<std::string>();
}

float number(const Json& object, const char* key, const std::string& subject) {
    const Json& value = member(object, key, subject);
    if (!value.is_number() || !std::isfinite(value.get<float>()))
        refuseValue(subject, key, value, "a finite number");
    return value.get<float>();
}

template <int size>
glm::vec<size, float> vector(const Json& object, const char* key, const std::string& subject) {
    const Json& value = member(object, key, subject);
    const auto isNumber = [](const Json& item) {
        return item.is_number() && std::isfinite(item.get<float>());
    };
    if (!value.is_array() || value.size() != size || !std::all_of(value.begin(), value.end(), isNumber))
        refuseValue(subject, key, value, std::to_string(size) + " finite numbers");
    glm::vec<size, float> result;
    for (int i = 0; i < size; ++i) result[i] = value[static_cast<size_t>(i)].get<float>();
    return result;
}

glm::vec3 unitVector(const Json& object, const char* key, const std::string& subject) {
    // In double, as squares of large floats overflow.
    const glm::dvec3 v(vector<3>(object, key, subject));
    if (!(glm::length(v) > 0.0)) refuseValue(subject, key, object[key], "a direction, which has a length");
    return glm::vec3(glm::normalize(v));
}

glm::vec3 intensityOf(const Json& object, const std::string& subject) {
    const glm::vec3 intensity = number(object, "intensity", subject) * vector<3>(object, "color", subject);
    for (int i = 0; i < 3; ++i)
        if (!(intensity[i] >= 0.0f) || !std::isfinite(intensity[i]))
            refuse(subject +
                   " has a product of the keys 'intensity' and 'color' that is negative or not finite");
    return intensity;
}

void readCone(const Json& object, const std::string& subject, Light& light) {
    const float degrees = number(object, "cone_degrees", subject);
    if (!(degrees > 0.0f && degrees <= 180.0f))
        refuseValue(subject, "cone_degrees", object["cone_degrees"],
                    "a full apex angle above 0 and up to 180");
    light.innerCone = light.outerCone = glm::radians(degrees) / 2.0f;
}

void readRectangle(const Json& object, const std::string& subject, Light& light) {
    light.size = vector<2>(object, "size", subject);
    if (!(light.size.x > 0.0f && light.size.y > 0.0f))
        refuseValue(subject, "size", object["size"], "two positive numbers");
    const glm::dvec3 right(unitVector(object, "right", subject));
    const glm::dvec3 normal(light.direction);
    const glm::dvec3 across = right - glm::dot(right, normal) * normal;
    if (glm::length(across) < 1e-3)
        refuseValue(subject, "right", object["right"], "a direction that is not the light's own");
    light.right = glm::vec3(glm::normalize(across));
}

LightType lightTypeOf(const Json& object, const std::string& subject) {
    const std::string name = text(object, "type", subject);
    if (name == "directional") return LightType::directional;
    if (name == "point") return LightType::point;
    if (name == "spot") return LightType::spot;
    if (name == "area") return LightType::area;
    refuseValue(subject, "type", object["type"], "directional, point, spot or area");
}

Light readLight(const Json& object, const std::string& subject) {
    if (!object.is_object()) refuse(subject + " is not an object");
    Light light;
    light.type = lightTypeOf(object, subject);
    light.name = text(object, object.contains("name") ? "name" : "type", subject);
    light.intensity = intensityOf(object, subject);
    if (light.type != LightType::directional) light.position = vector<3>(object, "position", subject);
    if (light.type != LightType::point) light.direction = unitVector(object, "direction", subject);
    if (light.type == LightType::spot) readCone(object, subject, light);
    if (light.type == LightType::area) readRectangle(object, subject, light);
    return light;
}

CameraView readCamera(const Json& object, const std::string& subject) {
    Result<CameraView> camera = cameraFromJson(object, subject);
    if (!camera) refuse(camera.error().message);
    if (text(object, "name", subject).empty())
        refuseValue(subject, "name", object["name"], "a name that is not empty");
    return std::move(*camera);
}

// Nothing where the key is absent.
template <class Read>
auto readList(const Json& root, const char* key, Read read) {
    std::optional<std::vector<decltype(read(root, std::string()))>> items;
    const auto list = root.find(key);
    if (list == root.end()) return items;
    if (!list->is_array()) refuseValue("the file", key, *list, "a list");
    items.emplace();
    for (const Json& item : *list)
        items->push_back(read(item, std::string(key) + "[" + std::to_string(items->size()) + "]"));
    return items;
}

std::optional<glm::vec3> readEnvironment(const Json& root) {
    if (!root.contains("environment")) return std::nullopt;
    const Json& environment = root["environment"];
    if (!environment.is_object()) refuseValue("the file", "environment", environment, "an object");
    if (text(environment, "type", "environment") != "constant")
        refuseValue("environment", "type", environment["type"], "constant");
    const glm::vec3 radiance = vector<3>(environment, "radiance", "environment");
    if (!(radiance.x >= 0.0f && radiance.y >= 0.0f && radiance.z >= 0.0f))
        refuseValue("environment", "radiance", environment["radiance"], "3 numbers that are not negative");
    return radiance;
}

std::optional<bool> readEmissiveFlag(const Json& root) {
    const auto flag = root.find("emissive_materials");
    if (flag == root.end()) return std::nullopt;
    if (!flag->is_boolean()) refuseValue("the file", "emissive_materials", *flag, "true or false");
    return flag->get<bool>();
}

// A misspelt key would leave the scene as it is without a word.
void noteUnknownKeys(const Json& root, const std::filesystem::path& file, std::vector<std::string>& notes) {
    constexpr const char* known[] = {"cameras",   "lights", "environment", "emissive_materials",
                                     "animation", "units"};
    std::string unknown;
    for (const auto& [key, value] : root.items())
        if (std::find(std::begin(known), std::end(known), key) == std::end(known))
            unknown += (unknown.empty() ? "" : ", ") + shown(key);
    if (!unknown.empty())
        notes.push_back(std::string("'").append(file.string()) + "': a view file has no key " + unknown +
                        ", which is left out");
}

GltfOptions readAnimation(const Json& root) {
    GltfOptions options;
    const auto animation = root.find("animation");
    if (animation == root.end()) return options;
    if (!animation->is_object()) refuseValue("the file", "animation", *animation, "an object");
    options.animation = text(*animation, "name", "animation");
    options.time = number(*animation, "time_s", "animation");
    options.animate = true;
    return options;
}

} // namespace

Result<ViewFile> readViewFile(const std::filesystem::path& file) {
    return guardInput(file, [&] {
        const Json root = readJson(file);
        ViewFile view;
        view.cameras = readList(root, "cameras", readCamera);
        view.lights = readList(root, "lights", readLight);
        view.environment = readEnvironment(root);
        view.emissiveMaterialsLight = readEmissiveFlag(root);
        view.animation = readAnimation(root);
        noteUnknownKeys(root, file, view.notes);
        return view;
    });
}

void applyViewFile(const ViewFile& view, Scene& scene) {
    if (view.cameras) scene.cameras = *view.cameras;
    if (view.lights) scene.lights = *view.lights;
    scene.environment = view.environment.value_or(scene.environment);
    scene.emissiveMaterialsLight = view.emissiveMaterialsLight.value_or(scene.emissiveMaterialsLight);
    scene.notes.insert(scene.notes.end(), view.notes.begin(), view.notes.end());
}

} // namespace rebound::lab
