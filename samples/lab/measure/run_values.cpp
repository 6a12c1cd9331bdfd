// SPDX-License-Identifier: MIT
#include "lab/measure/run_values.hpp"

#include "lab/techniques/draft_values.hpp"

namespace rebound::measure {

namespace {

constexpr std::pair<const char*, runner::Precision> precisionNames[] = {{"half", runner::Precision::half},
                                                                        {"float", runner::Precision::single}};

} // namespace

Result<Extent2D> parseSize(const std::string& what, const std::string& text) {
    const size_t times = text.find('x');
    const auto inRange = [](std::optional<int> side) { return side && *side >= 1 && *side <= maximumExtent; };
    if (times != std::string::npos) {
        const auto width = techniques::parseNumber<int>(std::string_view(text).substr(0, times));
        const auto height = techniques::parseNumber<int>(std::string_view(text).substr(times + 1));
        if (inRange(width) && inRange(height)) return Extent2D{*width, *height};
    }
    return techniques::unexpected(what, text,
                                  "WIDTHxHEIGHT, each 1 to " + std::to_string(maximumExtent) + " pixels,");
}

Result<runner::Precision> precisionNamed(const std::string& what, const std::string& name) {
    return techniques::valueNamed<runner::Precision>(what, name, precisionNames);
}

const char* nameOf(runner::Precision value) {
    return techniques::nameIn<runner::Precision>(precisionNames, value);
}

} // namespace rebound::measure
