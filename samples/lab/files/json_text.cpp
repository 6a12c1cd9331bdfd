// SPDX-License-Identifier: MIT
#include "lab/files/json_text.hpp"

#include "lab/files/input_error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
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

// Where reading went wrong, for people: `byte` counts from 1, and is that of the last one that was read.
std::string placeOf(std::string_view text, size_t byte) {
    if (byte > text.size()) return "it ends too early";
    const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const size_t start = before.rfind('\n');
    const size_t column = start == std::string_view::npos ? byte : byte - start - 1;
    return "it is damaged near line " + std::to_string(line) + ", column " + std::to_string(column);
}

} // namespace

nlohmann::json parseJsonObject(std::string_view text, const char* kind) {
    const std::string problem = std::string("it is not ") + kind + ": ";
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) refuse(problem + "it is empty");
    checkDepth(text);
    nlohmann::json root;
    try {
        root = nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& failure) {
        refuse(problem + "its JSON cannot be read, as " + placeOf(text, failure.byte));
    } catch (const nlohmann::json::exception&) {
        refuse(problem + "its JSON holds a number that is too large for double precision");
    }
    if (!root.is_object()) refuse(problem + "its JSON is " + shown(root) + ", not an object");
    return root;
}

std::string shown(const nlohmann::json& value) {
    constexpr size_t longest = 80;
    std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return text;
}

} // namespace rebound::lab
