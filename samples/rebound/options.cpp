// SPDX-License-Identifier: MIT
#include "options.hpp"

#include "memory_check.hpp"
#include "named_values.hpp"

#include <array>
#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

namespace rebound::cli {

namespace {

constexpr std::pair<const char*, StartResolution> startNames[] = {
    {"full", StartResolution::full}, {"half", StartResolution::half}, {"quarter", StartResolution::quarter}};
constexpr std::pair<const char*, Reduction> reductionNames[] = {{"nearest", Reduction::nearest},
                                                                {"voting", Reduction::voting}};
constexpr std::pair<const char*, FormFactor> formFactorNames[] = {{"disc", FormFactor::pointToDisc},
                                                                  {"point", FormFactor::pointToPoint}};
constexpr std::pair<const char*, runner::Precision> precisionNames[] = {{"half", runner::Precision::half},
                                                               {"float", runner::Precision::single}};

// A whole text as one number, without the sign and blanks that other parsers let pass.
template <class T>
std::optional<T> parseNumber(std::string_view text) {
    T value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

// Replaces a preset's value where an option was given.
template <class T>
Result<> replace(T& setting, const char* option, const std::optional<std::string>& wanted, Names<T> names) {
    if (!wanted)
        return {};
    const auto value = valueNamed<T>(option, *wanted, names);
    if (!value)
        return value.error();
    setting = *value;
    return {};
}

// After all other settings, on which the covering radius depends.
Result<> overrideRadius(ScreenIndirectSettings& settings, const std::optional<std::string>& wanted) {
    if (!wanted)
        return {};
    if (*wanted == "auto") {
        settings.ringRadius = coveringRingRadius(settings);
        return {};
    }
    const auto radius = parseNumber<float>(*wanted);
    if (!radius)
        return unexpected("--radius", *wanted, "auto or a number of texels, 1 to 1024,");
    settings.ringRadius = *radius;
    return {};
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 5> optionOfSetting{{
    {"settings.levels", "--levels"},
    {"settings.samplesPerLevel", "--samples"},
    {"settings.ringRadius", "--radius"},
    {"settings.minimumCosine", "--minimum-cosine"},
    {"settings.onlyLevel", "--only-level"},
}};

} // namespace

const char* nameOf(StartResolution value) {
    return nameIn<StartResolution>(startNames, value);
}
const char* nameOf(Reduction value) {
    return nameIn<Reduction>(reductionNames, value);
}
const char* nameOf(FormFactor value) {
    return nameIn<FormFactor>(formFactorNames, value);
}
const char* nameOf(runner::Precision value) {
    return nameIn<runner::Precision>(precisionNames, value);
}

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');)
        parts.push_back(part);
    return parts;
}

Result<Extent2D> parseSize(const std::string& text) {
    const size_t times = text.find('x');
    const auto inRange = [](std::optional<int> side) { return side && *side >= 1 && *side <= maximumExtent; };
    if (times != std::string::npos) {
        const auto width = parseNumber<int>(std::string_view(text).substr(0, times));
        const auto height = parseNumber<int>(std::string_view(text).substr(times + 1));
        if (inRange(width) && inRange(height))
            return Extent2D{*width, *height};
    }
    return unexpected("--size", text,
                      "WIDTHxHEIGHT, each 1 to " + std::to_string(maximumExtent) + " pixels,");
}

Result<ScreenIndirectSettings> settingsOf(const TechniqueOptions& options, Extent2D resolution) {
    auto preset = screenIndirectPreset(options.preset, resolution);
    if (!preset)
        return Error{preset.error().code, "--" + preset.error().message};
    ScreenIndirectSettings settings = *std::move(preset);
    if (auto set = replace<StartResolution>(settings.start, "--start", options.start, startNames); !set)
        return set.error();
    if (auto set = replace<Reduction>(settings.reduction, "--reduce", options.reduction, reductionNames);
        !set)
        return set.error();
    if (auto set =
            replace<FormFactor>(settings.formFactor, "--form-factor", options.formFactor, formFactorNames);
        !set)
        return set.error();
    settings.levels = options.levels.value_or(settings.levels);
    settings.samplesPerLevel = options.samples.value_or(settings.samplesPerLevel);
    settings.minimumCosine = options.minimumCosine.value_or(settings.minimumCosine);
    settings.onlyLevel = options.onlyLevel;
    // A number of levels out of range is planOf's to refuse; it has no covering radius.
    const bool hasRadius = settings.levels >= 1 && settings.levels <= 8;
    if (auto set = overrideRadius(settings, hasRadius ? options.radius : std::nullopt); !set)
        return set.error();
    return settings;
}

Result<Plan> planOf(const ScreenIndirectSettings& settings) {
    auto plan = planScreenIndirect(settings);
    if (plan)
        return plan;
    std::string message = plan.error().message;
    for (const auto& [setting, option] : optionOfSetting)
        if (message.starts_with(setting))
            message.replace(0, setting.size(), option);
    return Error{plan.error().code, message};
}

Result<std::unique_ptr<runner::Backend>> createBackend(const DeviceChoice& choice) {
    const auto isa = cpu::isaFromName(choice.isa);
    if (!isa)
        return Error{isa.error().code, "--" + isa.error().message};
    if (choice.backend == "cpu" && !choice.device.empty())
        return unexpected("--device", choice.device, "--backend vulkan or opengl");
    auto backend = runner::createBackend({choice.backend, choice.device, *isa, choice.threads, false});
    if (backend || backend.error().message.starts_with("Vulkan: ") || backend.error().message.starts_with("OpenGL: "))
        return backend;
    return Error{backend.error().code, "--" + backend.error().message};
}

Result<runner::Precision> precisionOf(const DeviceChoice& choice) {
    return valueNamed<runner::Precision>("--precision", choice.precision, precisionNames);
}

Result<Preparation> prepare(const TechniqueOptions& technique, const DeviceChoice& choice) {
    const auto extent = parseSize(technique.size);
    if (!extent)
        return extent.error();
    const auto settings = settingsOf(technique, *extent);
    if (!settings)
        return settings.error();
    const auto plan = planOf(*settings);
    if (!plan)
        return plan.error();
    const auto precision = precisionOf(choice);
    if (!precision)
        return precision.error();
    auto backend = createBackend(choice);
    if (!backend)
        return backend.error();
    if (auto enough = checkMemory(**backend, *plan, *extent); !enough)
        return enough.error();
    return Preparation{*std::move(backend), *precision, *extent};
}

} // namespace rebound::cli
