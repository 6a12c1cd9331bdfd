// SPDX-License-Identifier: MIT
// Settings of the technique as people write them, on a command line or in a file.
#pragma once

#include "lab/runner/runner.hpp"
#include "rebound/techniques/screen_indirect.hpp"

#include <optional>
#include <string>

namespace rebound::measure {

// What is absent is the preset's.
struct SettingsDraft {
    std::string preset = "quarter-64";
    std::optional<std::string> start, radius, reduction, formFactor, smooth, coverScreen;
    std::optional<std::string> samples; // a number, or all
    std::optional<int> levels, onlyLevel;
    std::optional<float> minimumCosine;
};

// How errors call a setting: --form-factor on a command line, form_factor in a file.
enum class Spelling { options, keys };

// The preset with the draft's own values, at that resolution. The result is not validated.
Result<ScreenIndirectSettings> settingsOf(const SettingsDraft&, Extent2D resolution, Spelling);

// A plan, with errors that spell settings so.
Result<Plan> planOf(const ScreenIndirectSettings&, Spelling);

// The same error about settings.levels and its like, spelled so.
Error spelled(Error, Spelling);

// WIDTHxHEIGHT, each 1 to maximumExtent; `what` is what the error calls it.
Result<Extent2D> parseSize(const std::string& what, const std::string& text);

// half or float; `what` is what the error calls it.
Result<runner::Precision> precisionNamed(const std::string& what, const std::string& name);

// How drafts spell a setting's value.
const char* nameOf(StartResolution);
const char* nameOf(Reduction);
const char* nameOf(FormFactor);
const char* nameOf(runner::Precision);
std::string samplesText(const ScreenIndirectSettings&); // 4 to 256, or all

} // namespace rebound::measure
