// SPDX-License-Identifier: MIT
// What is wrong with a command line, in the words of the program. For programs that link CLI11.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>

namespace rebound::lab {

namespace detail {

// The option of that name, of the program or of a command that was given.
inline const CLI::Option* findOption(const CLI::App& app, const std::string& name) {
    for (const CLI::Option* option : app.get_options())
        if (option->get_name() == name) return option;
    for (const CLI::App* command : app.get_subcommands())
        if (const CLI::Option* option = findOption(*command, name)) return option;
    return nullptr;
}

inline std::string expectedValue(const CLI::Option* option) {
    const std::string type = option ? option->get_type_name() : "";
    if (type.starts_with("INT")) return "a whole number";
    if (type.starts_with("UINT")) return "a whole number that is not negative";
    if (type.starts_with("FLOAT")) return "a number";
    return "another value";
}

// Cuts a text at the first occurrence of a separator; false where there is none.
inline bool cut(std::string_view text, std::string_view separator, std::string& before, std::string& after) {
    const size_t at = text.find(separator);
    if (at == std::string_view::npos) return false;
    before = text.substr(0, at);
    after = text.substr(at + separator.size());
    return true;
}

} // namespace detail

// One sentence that names option, value and expectation. CLI11 2.1 hands on what it knows within its own sentences only.
inline std::string sentenceOf(const CLI::App& app, const CLI::ParseError& error) {
    const std::string kind = error.get_name(), message = error.what();
    const std::string help = "; " + app.get_name() + " --help says which there are";
    std::string before, name, value, range;
    if (kind == "ConversionError" && detail::cut(message, "Could not convert: ", before, name)) {
        const std::string rest = name;
        if (detail::cut(rest, " = ", name, value))
            return name + " is \"" + value + "\"; " + detail::expectedValue(detail::findOption(app, name)) +
                   " was expected";
    }
    if (kind == "ValidationError" && detail::cut(message, ": ", name, value)) {
        const std::string rest = value;
        if (detail::cut(rest, " not in range ", value, range)) {
            constexpr std::string_view word = "Value ";
            return name + " is " + (value.starts_with(word) ? value.substr(word.size()) : value) + "; " +
                   range + " was expected";
        }
        return name + " has a value that was not expected";
    }
    // Such errors go by the name of the command.
    if (detail::cut(message, "not expected: ", before, value))
        return "the command line holds \"" + value + "\", which is not known" + help;
    if (kind == "RequiredError" && detail::cut(message, " is required", name, before))
        return name + " is missing; it has to be given";
    if (kind == "ExcludesError" && detail::cut(message, " excludes ", name, value))
        return name + " was given together with " + value + "; one of the two was expected";
    if (kind == "ArgumentMismatch" && detail::cut(message, ": ", name, value))
        return name + (value.starts_with("At Most") ? " was given more than once; once was expected"
                                                    : " has no value; one was expected");
    if (kind == "ArgumentMismatch" && detail::cut(message, " was given a", name, value))
        return name + " was given a value; none was expected";
    return "the command line cannot be understood" + help;
}

} // namespace rebound::lab
