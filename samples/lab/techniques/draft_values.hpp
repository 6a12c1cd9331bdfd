// SPDX-License-Identifier: MIT
// Reads a draft's values; errors spell the option and say what was expected.
#pragma once

#include "lab/techniques/named_values.hpp"
#include "lab/techniques/technique.hpp"

#include <charconv>
#include <optional>
#include <string_view>

namespace rebound::techniques {

// A whole text as one number, without the sign and blanks that other parsers let pass.
template <class T>
std::optional<T> parseNumber(std::string_view text) {
    T value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

class DraftValues {
public:
    DraftValues(const Draft& d, Spelling s) : draft(d), spelling(s) {}

    // Null where the draft has no such option.
    const std::string* find(const std::string& option) const {
        const auto found = draft.find(option);
        return found == draft.end() ? nullptr : &found->second;
    }
    std::string called(const std::string& option) const { return spelled(option, spelling); }

    // Each of these replaces a value where the draft has another; the first failure stays, and is kept in error().
    template <class T>
    void replaceByName(T& value, const std::string& option, Names<T> names) {
        if (const std::string* text = find(option)) take(value, valueNamed<T>(called(option), *text, names));
    }
    template <class T>
    void replaceByNumber(T& value, const std::string& option, const std::string& expected) {
        const std::string* text = find(option);
        if (!text) return;
        const auto number = parseNumber<T>(*text);
        take(value, number ? Result<T>(*number) : unexpected(called(option), *text, expected));
    }
    template <class T>
    void take(T& value, const Result<T>& result) {
        if (result) value = *result;
        else if (failure) failure = result.error();
    }

    const Result<>& error() const { return failure; }

private:
    const Draft& draft;
    Spelling spelling;
    Result<> failure = {};
};

} // namespace rebound::techniques
