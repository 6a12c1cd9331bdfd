// SPDX-License-Identifier: MIT
#include "lab/gltf/data_uri.hpp"

#include "lab/files/input_error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace rebound::lab {
namespace {

constexpr std::string_view scheme = "data:";

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
    });
}

std::optional<uint32_t> sextet(char c) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t at = alphabet.find(c);
    if (at == std::string_view::npos) return std::nullopt;
    return static_cast<uint32_t>(at);
}

// RFC 4648, section 4. Blanks and line ends between characters do no harm; padding may be absent.
std::vector<uint8_t> decodeBase64(std::string_view text, const std::string& subject) {
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    uint32_t bits = 0;
    int count = 0; // of bits that wait for a byte
    size_t digits = 0;
    size_t at = 0;
    for (; at < text.size() && text[at] != '='; ++at) {
        if (std::isspace(static_cast<unsigned char>(text[at]))) continue;
        const auto value = sextet(text[at]);
        if (!value)
            refuse(subject + " has a data URI whose base64 is damaged at its character " +
                   std::to_string(at));
        bits = bits << 6 | *value;
        count += 6;
        ++digits;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<uint8_t>(bits >> count));
        bits &= (1u << count) - 1u;
    }
    const bool isPadding =
        std::all_of(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(),
                    [](char c) { return c == '=' || std::isspace(static_cast<unsigned char>(c)); });
    if (!isPadding || digits % 4 == 1) refuse(subject + " has a data URI whose base64 is damaged at its end");
    return bytes;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return uri.size() >= scheme.size() && equalsIgnoringCase(uri.substr(0, scheme.size()), scheme);
}

std::string decodePercent(std::string_view text) {
    const auto digit = [&](size_t i) {
        return i < text.size() && std::isxdigit(static_cast<unsigned char>(text[i])) != 0;
    };
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const bool escaped = text[i] == '%' && digit(i + 1) && digit(i + 2);
        decoded +=
            escaped ? static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16)) : text[i];
        i += escaped ? 2 : 0;
    }
    return decoded;
}

std::vector<uint8_t> decodeDataUri(std::string_view uri, const std::string& subject) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        refuse(subject + " has a data URI without a comma; expected data:[<media type>][;base64],<data>");
    const std::string_view header = uri.substr(scheme.size(), comma - scheme.size());
    const size_t last = header.rfind(';');
    const bool isBase64 =
        last != std::string_view::npos && equalsIgnoringCase(header.substr(last + 1), "base64");
    const std::string content = decodePercent(uri.substr(comma + 1));
    if (isBase64) return decodeBase64(content, subject);
    return {content.begin(), content.end()};
}

} // namespace rebound::lab
