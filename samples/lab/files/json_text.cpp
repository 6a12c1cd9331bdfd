// SPDX-License-Identifier: MIT
#include "lab/files/json_text.hpp"

#include "lab/files/input_error.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace rebound::lab {
namespace {

// Counts brackets outside of strings. The parser's own callback costs time by the square of a list's length.
void checkDepth(std::string_view text) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') inString = !inString;
        else if (inString) i += c == '\\' ? 1 : 0;
        else if (c == '[' || c == '{') ++depth;
        else if (c == ']' || c == '}') --depth;
        if (depth > deepestJson)
            refuse("its JSON is nested deeper than " + std::to_string(deepestJson) + " levels");
    }
}

} // namespace

nlohmann::json parseJsonObject(std::string_view text, const char* kind) {
    checkDepth(text);
    nlohmann::json root;
    try {
        root = nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& failure) {
        refuse(std::string("it is not ") + kind + ": " + failure.what());
    }
    if (!root.is_object()) refuse(std::string("it is not ") + kind + ": its JSON is not an object");
    return root;
}

} // namespace rebound::lab
