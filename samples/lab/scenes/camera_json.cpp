// SPDX-License-Identifier: MIT
#include "lab/scenes/camera_json.hpp"

#include "lab/files/json_text.hpp"
#include "lab/rays/camera_rays.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rebound::lab {

namespace {

using Json = nlohmann::json;

Error invalid(const std::string& context, const std::string& key, const Json& value, const char* expected) {
    return {ErrorCode::invalidData,
            context + ": \"" + key + "\" is " + shown(value) + "; expected " + expected};
}

// Each reader leaves its output alone where the key is absent, and says whether that is an error.
Result<> readNumber(const Json& object, const char* key, const std::string& context, float& number) {
    const auto found = object.find(key);
    if (found == object.end()) return {};
    if (!found->is_number() || !std::isfinite(found->get<float>()))
        return invalid(context, key, *found, "a finite number");
    number = found->get<float>();
    return {};
}

Result<> readVector(const Json& object, const char* key, const std::string& context, glm::vec3& vector) {
    const auto found = object.find(key);
    if (found == object.end()) return {};
    if (!found->is_array() || found->size() != 3) return invalid(context, key, *found, "three numbers");
    for (int i = 0; i < 3; ++i) {
        const Json& component = (*found)[size_t(i)];
        if (!component.is_number() || !std::isfinite(component.get<float>()))
            return invalid(context, key, *found, "three finite numbers");
        vector[i] = component.get<float>();
    }
    return {};
}

Result<> readProjection(const Json& object, const std::string& context, CameraView& camera) {
    const bool perspective = object.contains("vfov_degrees");
    camera.orthographic = object.contains("orthographic_height");
    if (perspective == camera.orthographic)
        return Error{ErrorCode::invalidData,
                     context + ": expected one of \"vfov_degrees\" and \"orthographic_height\", found " +
                         (perspective ? "both" : "neither")};
    float degrees = 0.0f;
    if (auto read = readNumber(object, "vfov_degrees", context, degrees); !read) return read;
    if (perspective) camera.verticalFieldOfView = glm::radians(degrees);
    return readNumber(object, "orthographic_height", context, camera.orthographicHeight);
}

} // namespace

Result<CameraView> cameraFromJson(const Json& object, const std::string& context) {
    if (!object.is_object())
        return Error{ErrorCode::invalidData, context + ": expected an object, found " + object.type_name()};
    CameraView camera;
    if (const auto name = object.find("name"); name != object.end()) {
        if (!name->is_string()) return invalid(context, "name", *name, "a string");
        camera.name = name->get<std::string>();
    }
    for (const char* key : {"position", "target"})
        if (!object.contains(key))
            return Error{ErrorCode::invalidData, context + ": \"" + key + "\" is missing"};
    for (auto [key, vector] : {std::pair{"position", &camera.position}, std::pair{"target", &camera.target},
                               std::pair{"up", &camera.up}})
        if (auto read = readVector(object, key, context, *vector); !read) return read.error();
    for (auto [key, number] : {std::pair{"near", &camera.nearPlane}, std::pair{"far", &camera.farPlane}})
        if (auto read = readNumber(object, key, context, *number); !read) return read.error();
    if (auto read = readProjection(object, context, camera); !read) return read.error();
    if (auto valid = validate(camera); !valid)
        return Error{ErrorCode::invalidData, context + ": " + valid.error().message};
    return camera;
}

nlohmann::json cameraToJson(const CameraView& camera) {
    const auto vector = [](glm::vec3 v) { return Json::array({v.x, v.y, v.z}); };
    Json json{{"name", camera.name},
              {"position", vector(camera.position)},
              {"target", vector(camera.target)},
              {"up", vector(camera.up)},
              {"near", camera.nearPlane},
              // JSON has no infinity.
              {"far", std::min(camera.farPlane, std::numeric_limits<float>::max())}};
    if (camera.orthographic) json["orthographic_height"] = camera.orthographicHeight;
    else json["vfov_degrees"] = glm::degrees(camera.verticalFieldOfView);
    return json;
}

} // namespace rebound::lab
