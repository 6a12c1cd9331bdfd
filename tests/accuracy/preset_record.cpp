// SPDX-License-Identifier: MIT
#include "preset_record.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace rebound::accuracy {
namespace {

using Json = nlohmann::ordered_json;

// Compilers and instruction sets differ by less than 0.1 %; what is smaller than this shows in no picture.
constexpr double allowedChange = 0.01;

ScreenIndirectSettings presetOf(std::string_view name, Extent2D extent) {
    auto settings = screenIndirectPreset(name, extent);
    if (!settings) throw std::runtime_error(settings.error().message);
    return *settings;
}

// One level whose open ring holds every texel.
ScreenIndirectSettings bruteForceOver(ScreenIndirectSettings settings) {
    settings.levels = 1;
    settings.samplesPerLevel = wholeRings;
    settings.smooth = false;
    return settings;
}

Json errorOn(const ReferenceView& view, const ScreenIndirectSettings& settings) {
    const ImageError error = errorOf(gather(view, settings), view);
    return {std::round(error.relativeRmse * 1e4) / 1e4, std::round(error.mean * 1e4) / 1e4};
}

Json errorsOf(const ReferenceView& view, bool withBruteForce) {
    const Extent2D extent = view.frame.depth.extent();
    Json errors;
    for (std::string_view preset : screenIndirectPresetNames())
        errors[std::string(preset)] = errorOn(view, presetOf(preset, extent));
    if (withBruteForce)
        errors["brute force over a quarter"] = errorOn(view, bruteForceOver(presetOf("quarter-64", extent)));
    return errors;
}

void checkUnchanged(double now, double stated, const std::string& what) {
    INFO(what, " is ", now, ", stated: ", stated);
    CHECK(std::abs(now - stated) <= allowedChange * stated);
}

} // namespace

PresetRecord::PresetRecord(const std::filesystem::path& path) : name(path.filename().string()) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("there is no " + path.string());
    stated = Json::parse(file);
}

void PresetRecord::check(const ReferenceView& view, bool withBruteForce) {
    CAPTURE(view.name);
    const Json& errors = now[view.name] = errorsOf(view, withBruteForce);
    std::cout << view.name << ' ' << errors.dump() << std::endl; // what takes minutes is not lost
    CHECK_MESSAGE(stated.contains(view.name), name, " does not hold this view");
    if (!stated.contains(view.name)) return;
    for (const auto& [preset, error] : errors.items()) {
        CAPTURE(preset);
        const Json& expected = stated.at(view.name).at(preset);
        checkUnchanged(error[0], expected[0], "relative RMSE");
        checkUnchanged(error[1], expected[1], "mean over the truth's mean");
    }
}

// A view a line and a preset a line, as people compare them.
std::string PresetRecord::measured() const {
    std::string text = "{";
    for (const auto& [view, errors] : now.items()) {
        text += (text == "{" ? "\n \"" : ",\n \"") + view + "\": {";
        bool first = true;
        for (const auto& [preset, error] : errors.items()) {
            text += (first ? "\n  \"" : ",\n  \"") + preset + "\": [" + error[0].dump() + ", " +
                    error[1].dump() + "]";
            first = false;
        }
        text += "\n }";
    }
    return name + " as it is now:\n" + text + "\n}\n";
}

} // namespace rebound::accuracy
