// SPDX-License-Identifier: MIT
// Values of JSON that nobody vouches for, with errors that say where they are and what was expected.
#pragma once

#include "lab/files/input_error.hpp"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rebound::lab {

// Short enough for a sentence.
inline std::string shortText(const nlohmann::json& value) {
    std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (text.size() > 80) text = text.substr(0, 80) + "...";
    return text;
}

// All of these throw InputError; `where` is the path to the value, such as reference.samples.
[[noreturn]] inline void refuseValue(const std::string& where, const nlohmann::json& value,
                                     const std::string& expected) {
    refuse(where + " is " + shortText(value) + "; " + expected + " was expected");
}

inline const nlohmann::json& member(const nlohmann::json& object, const std::string& key,
                                    const std::string& where) {
    const auto found = object.find(key);
    if (found == object.end()) refuse(where + " is missing");
    return *found;
}

inline void checkKeys(const nlohmann::json& object, const std::string& where,
                      const std::vector<std::string>& known) {
    if (!object.is_object()) refuseValue(where, object, "an object");
    std::string list;
    for (const std::string& key : known) list += (list.empty() ? "" : ", ") + key;
    for (const auto& [key, value] : object.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            refuse((where.empty() ? "" : where + ": ") + "the key " + shortText(nlohmann::json(key)) +
                   " is unknown; some of " + list + " were expected");
}

inline std::string textOf(const nlohmann::json& value, const std::string& where) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
        refuseValue(where, value, "a text");
    return value.get<std::string>();
}

inline double numberOf(const nlohmann::json& value, const std::string& where, double low, double high) {
    char range[80];
    std::snprintf(range, sizeof range, "a number, %g to %g,", low, high);
    if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high))
        refuseValue(where, value, range);
    return value.get<double>();
}

inline int integerOf(const nlohmann::json& value, const std::string& where, int low, int high) {
    const bool isWhole = value.is_number() && std::floor(value.get<double>()) == value.get<double>();
    if (!isWhole || value.get<double>() < low || value.get<double>() > high)
        refuseValue(where, value,
                    "a whole number, " + std::to_string(low) + " to " + std::to_string(high) + ",");
    return value.get<int>();
}

inline glm::vec3 vectorOf(const nlohmann::json& value, const std::string& where, double most) {
    if (!value.is_array() || value.size() != 3) refuseValue(where, value, "three numbers");
    glm::vec3 vector;
    for (int i = 0; i < 3; ++i)
        vector[i] = float(numberOf(value[size_t(i)], where + "[" + std::to_string(i) + "]", -most, most));
    return vector;
}

inline const nlohmann::json& arrayOf(const nlohmann::json& value, const std::string& where) {
    if (!value.is_array() || value.empty()) refuseValue(where, value, "an array that is not empty");
    return value;
}

} // namespace rebound::lab
