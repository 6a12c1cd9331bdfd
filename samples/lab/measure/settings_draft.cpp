// SPDX-License-Identifier: MIT
#include "lab/measure/settings_draft.hpp"

#include "lab/measure/named_values.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace rebound::measure {

namespace {

constexpr std::pair<const char*, StartResolution> startNames[] = {
    {"full", StartResolution::full}, {"half", StartResolution::half}, {"quarter", StartResolution::quarter}};
constexpr std::pair<const char*, Reduction> reductionNames[] = {{"nearest", Reduction::nearest},
                                                                {"voting", Reduction::voting}};
constexpr std::pair<const char*, FormFactor> formFactorNames[] = {{"disc", FormFactor::pointToDisc},
                                                                  {"point", FormFactor::pointToPoint}};
constexpr std::pair<const char*, bool> switchNames[] = {{"on", true}, {"off", false}};
constexpr std::pair<const char*, runner::Precision> precisionNames[] = {{"half", runner::Precision::half},
                                                                        {"float", runner::Precision::single}};

// From the option's name without its dashes.
std::string spelledName(std::string name, Spelling spelling) {
    if (spelling == Spelling::options) return "--" + name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

// A whole text as one number, without the sign and blanks that other parsers let pass.
template <class T>
std::optional<T> parseNumber(std::string_view text) {
    T value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// Replaces a preset's value where the draft has one.
template <class T>
Result<> replace(T& setting, const std::string& what, const std::optional<std::string>& wanted,
                 Names<T> names) {
    if (!wanted) return {};
    const auto value = valueNamed<T>(what, *wanted, names);
    if (!value) return value.error();
    setting = *value;
    return {};
}

// After all other settings, on which the covering radius depends.
Result<> replaceRadius(ScreenIndirectSettings& settings, const std::string& what,
                       const std::optional<std::string>& wanted) {
    if (!wanted) return {};
    if (*wanted == "auto") {
        settings.ringRadius = coveringRingRadius(settings);
        return {};
    }
    const auto radius = parseNumber<float>(*wanted);
    if (!radius) return unexpected(what, *wanted, "auto or a number of texels, 1 to 1024,");
    settings.ringRadius = *radius;
    return {};
}

Result<> replaceSamples(int& setting, const std::string& what, const std::optional<std::string>& wanted) {
    if (!wanted) return {};
    const auto samples = *wanted == "all" ? std::optional<int>(wholeRings) : parseNumber<int>(*wanted);
    if (!samples || ((*samples < 4 || *samples > 256) && *samples != wholeRings))
        return unexpected(what, *wanted, "4 to 256, or all,");
    setting = *samples;
    return {};
}

constexpr std::array<std::pair<std::string_view, const char*>, 4> nameOfSetting{{
    {"settings.levels", "levels"},
    {"settings.ringRadius", "radius"},
    {"settings.minimumCosine", "minimum-cosine"},
    {"settings.onlyLevel", "only-level"},
}};

} // namespace

const char* nameOf(StartResolution value) { return nameIn<StartResolution>(startNames, value); }
const char* nameOf(Reduction value) { return nameIn<Reduction>(reductionNames, value); }
const char* nameOf(FormFactor value) { return nameIn<FormFactor>(formFactorNames, value); }
const char* nameOf(runner::Precision value) { return nameIn<runner::Precision>(precisionNames, value); }

std::string samplesText(const ScreenIndirectSettings& s) {
    return s.samplesPerLevel == wholeRings ? "all" : std::to_string(s.samplesPerLevel);
}

Result<Extent2D> parseSize(const std::string& what, const std::string& text) {
    const size_t times = text.find('x');
    const auto inRange = [](std::optional<int> side) { return side && *side >= 1 && *side <= maximumExtent; };
    if (times != std::string::npos) {
        const auto width = parseNumber<int>(std::string_view(text).substr(0, times));
        const auto height = parseNumber<int>(std::string_view(text).substr(times + 1));
        if (inRange(width) && inRange(height)) return Extent2D{*width, *height};
    }
    return unexpected(what, text, "WIDTHxHEIGHT, each 1 to " + std::to_string(maximumExtent) + " pixels,");
}

Result<runner::Precision> precisionNamed(const std::string& what, const std::string& name) {
    return valueNamed<runner::Precision>(what, name, precisionNames);
}

Result<ScreenIndirectSettings> settingsOf(const SettingsDraft& draft, Extent2D resolution,
                                          Spelling spelling) {
    auto preset = screenIndirectPreset(draft.preset, resolution);
    if (!preset)
        return Error{preset.error().code,
                     (spelling == Spelling::options ? "--" : "") + preset.error().message};
    ScreenIndirectSettings settings = *std::move(preset);
    const auto called = [&](const char* name) { return spelledName(name, spelling); };
    if (auto set = replace<StartResolution>(settings.start, called("start"), draft.start, startNames); !set)
        return set.error();
    if (auto set = replace<Reduction>(settings.reduction, called("reduce"), draft.reduction, reductionNames);
        !set)
        return set.error();
    if (auto set = replace<FormFactor>(settings.formFactor, called("form-factor"), draft.formFactor,
                                       formFactorNames);
        !set)
        return set.error();
    if (auto set = replace<bool>(settings.smooth, called("smooth"), draft.smooth, switchNames); !set)
        return set.error();
    if (auto set =
            replace<bool>(settings.coverScreen, called("cover-screen"), draft.coverScreen, switchNames);
        !set)
        return set.error();
    settings.levels = draft.levels.value_or(settings.levels);
    if (auto set = replaceSamples(settings.samplesPerLevel, called("samples"), draft.samples); !set)
        return set.error();
    settings.minimumCosine = draft.minimumCosine.value_or(settings.minimumCosine);
    settings.onlyLevel = draft.onlyLevel;
    // A number of levels out of range is planOf's to refuse; it has no covering radius.
    const bool hasRadius = settings.levels >= 1 && settings.levels <= 8;
    if (auto set = replaceRadius(settings, called("radius"), hasRadius ? draft.radius : std::nullopt); !set)
        return set.error();
    return settings;
}

Error spelled(Error error, Spelling spelling) {
    for (const auto& [setting, name] : nameOfSetting)
        if (error.message.starts_with(setting))
            error.message.replace(0, setting.size(), spelledName(name, spelling));
    return error;
}

Result<Plan> planOf(const ScreenIndirectSettings& settings, Spelling spelling) {
    auto plan = planScreenIndirect(settings);
    if (!plan) return spelled(plan.error(), spelling);
    return plan;
}

} // namespace rebound::measure
