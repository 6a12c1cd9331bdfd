// SPDX-License-Identifier: MIT
#include "rebound/techniques/screen_indirect.hpp"

#include "lab/scenes/camera_matrices.hpp"
#include "lab/techniques/draft_values.hpp"

#include <algorithm>
#include <array>

namespace rebound::techniques {

namespace {

constexpr std::pair<const char*, StartResolution> startNames[] = {
    {"full", StartResolution::full}, {"half", StartResolution::half}, {"quarter", StartResolution::quarter}};
constexpr std::pair<const char*, Reduction> reductionNames[] = {{"nearest", Reduction::nearest},
                                                                {"voting", Reduction::voting}};
constexpr std::pair<const char*, FormFactor> formFactorNames[] = {{"disc", FormFactor::pointToDisc},
                                                                  {"point", FormFactor::pointToPoint}};
constexpr std::pair<const char*, bool> switchNames[] = {{"on", true}, {"off", false}};

constexpr const char* usualPreset = "quarter-64";

std::string presetOf(const Draft& draft) {
    const auto found = draft.find("preset");
    return found == draft.end() ? usualPreset : found->second;
}

// planScreenIndirect()'s errors, with options' names.
Error renamed(Error error, Spelling spelling) {
    constexpr std::array<std::pair<std::string_view, const char*>, 4> options{{
        {"settings.levels", "levels"},
        {"settings.ringRadius", "radius"},
        {"settings.minimumCosine", "minimum-cosine"},
        {"settings.onlyLevel", "only-level"},
    }};
    for (const auto& [setting, option] : options)
        if (error.message.starts_with(setting))
            error.message.replace(0, setting.size(), spelled(option, spelling));
    return error;
}

void replaceSamples(ScreenIndirectSettings& settings, DraftValues& values) {
    const std::string* text = values.find("samples");
    if (!text) return;
    const auto samples = *text == "all" ? std::optional<int>(wholeRings) : parseNumber<int>(*text);
    const bool isSetting = samples && ((*samples >= 4 && *samples <= 256) || *samples == wholeRings);
    values.take(settings.samplesPerLevel,
                isSetting ? Result<int>(*samples)
                          : unexpected(values.called("samples"), *text, "4 to 256, or all,"));
}

std::string samplesText(const ScreenIndirectSettings& s) {
    return s.samplesPerLevel == wholeRings ? "all" : std::to_string(s.samplesPerLevel);
}

// After all other settings, on which the covering radius depends.
void replaceRadius(ScreenIndirectSettings& settings, DraftValues& values) {
    const std::string* text = values.find("radius");
    // A number of levels out of range is planScreenIndirect()'s to refuse; it has no covering radius.
    if (!text || settings.levels < 1 || settings.levels > 8) return;
    if (*text == "auto") settings.ringRadius = coveringRingRadius(settings);
    else values.replaceByNumber(settings.ringRadius, "radius", "auto or a number of texels, 1 to 1024,");
}

// The preset with the draft's own values.
Result<ScreenIndirectSettings> settingsOf(const Draft& draft, const View& view, Spelling spelling) {
    auto preset = screenIndirectPreset(presetOf(draft), view.size);
    if (!preset)
        return Error{preset.error().code,
                     (spelling == Spelling::options ? "--" : "") + preset.error().message};
    ScreenIndirectSettings settings = *std::move(preset);
    settings.conventions.projection = view.projection;
    DraftValues values(draft, spelling);
    values.replaceByName<StartResolution>(settings.start, "start", startNames);
    values.replaceByName<Reduction>(settings.reduction, "reduce", reductionNames);
    values.replaceByName<FormFactor>(settings.formFactor, "form-factor", formFactorNames);
    values.replaceByName<bool>(settings.smooth, "smooth", switchNames);
    values.replaceByName<bool>(settings.coverScreen, "cover-screen", switchNames);
    values.replaceByNumber(settings.levels, "levels", "a whole number, 1 to 8,");
    replaceSamples(settings, values);
    values.replaceByNumber(settings.minimumCosine, "minimum-cosine", "a number, 0.001 to 1,");
    if (values.find("only-level")) {
        settings.onlyLevel = 0;
        values.replaceByNumber(*settings.onlyLevel, "only-level", "a level's number, from 0,");
    }
    replaceRadius(settings, values);
    if (!values.error()) return values.error().error();
    return settings;
}

Json toJson(const ScreenIndirectSettings& s, const std::string& preset) {
    Json json;
    json["preset"] = preset;
    json["start"] = nameIn<StartResolution>(startNames, s.start);
    json["levels"] = s.levels;
    if (s.samplesPerLevel == wholeRings) json["samples_per_level"] = "all";
    else json["samples_per_level"] = s.samplesPerLevel;
    json["ring_radius_texels"] = s.ringRadius;
    json["reduction"] = nameIn<Reduction>(reductionNames, s.reduction);
    json["form_factor"] = nameIn<FormFactor>(formFactorNames, s.formFactor);
    json["minimum_cosine"] = s.minimumCosine;
    json["cover_screen"] = s.coverScreen;
    json["smooth"] = s.smooth;
    json["only_level"] = s.onlyLevel ? Json(*s.onlyLevel) : Json(nullptr);
    return json;
}

std::string shortNumber(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", double(value));
    return text;
}

// half-64, quarter-64-5 nearest: what is the presets' is not said.
std::string nameOf(const ScreenIndirectSettings& s) {
    std::string name = std::string(nameIn<StartResolution>(startNames, s.start)) + "-" + samplesText(s);
    const auto usual = screenIndirectPreset(usualPreset, s.resolution);
    if (s.levels != 4) name.append("-").append(std::to_string(s.levels));
    if (s.reduction != Reduction::voting)
        name += std::string(" ") + nameIn<Reduction>(reductionNames, s.reduction);
    if (s.formFactor != FormFactor::pointToDisc)
        name += std::string(" form factor ") + nameIn<FormFactor>(formFactorNames, s.formFactor);
    if (usual && s.ringRadius != usual->ringRadius) name += " radius " + shortNumber(s.ringRadius);
    if (usual && s.minimumCosine != usual->minimumCosine)
        name += " minimum cosine " + shortNumber(s.minimumCosine);
    if (!s.coverScreen) name += " not covering";
    if (!s.smooth) name += " not smoothed";
    if (s.onlyLevel) name += " only level " + std::to_string(*s.onlyLevel);
    return name;
}

std::string describe(const ScreenIndirectSettings& s, const std::string& preset) {
    std::string text = preset + ": from " + nameIn<StartResolution>(startNames, s.start) + " resolution, " +
                       std::to_string(s.levels) + (s.levels == 1 ? " level, " : " levels, ") +
                       samplesText(s) + " samples a level, ring radius " + shortNumber(s.ringRadius) +
                       " texels, " + nameIn<Reduction>(reductionNames, s.reduction) + ", form factor " +
                       nameIn<FormFactor>(formFactorNames, s.formFactor) + ", minimum cosine " +
                       shortNumber(s.minimumCosine);
    if (!s.coverScreen) text += ", not covering the screen";
    if (!s.smooth) text += ", not smoothed";
    if (s.onlyLevel) text += ", only level " + std::to_string(*s.onlyLevel);
    return text;
}

Result<Configured> configured(const ScreenIndirectSettings& settings, const std::string& preset) {
    auto plan = planScreenIndirect(settings);
    if (!plan) return plan.error();
    Configured result{
        toJson(settings, preset), nameOf(settings), describe(settings, preset), *std::move(plan), {}};
    result.inputs = [settings](const lab::Frame& frame, const lab::Image& radiance) {
        return screenIndirectInputs(
            settings, ScreenIndirectFrame<lab::Image>{lab::cameraMatrices(frame.camera, settings.resolution),
                                                      frame.depth,
                                                      frame.normal,
                                                      radiance,
                                                      frame.albedo,
                                                      radiance,
                                                      {},
                                                      {}});
    };
    return result;
}

Result<Configured> parse(const Draft& draft, const View& view, Spelling spelling) {
    const auto settings = settingsOf(draft, view, spelling);
    if (!settings) return settings.error();
    auto result = configured(*settings, presetOf(draft));
    if (!result) return renamed(result.error(), spelling);
    return result;
}

Result<std::vector<Ablation>> ablations(const Draft& draft, const View& view) {
    const auto given = settingsOf(draft, view, Spelling::options);
    if (!given) return given.error();
    ScreenIndirectSettings allSamples = *given;
    allSamples.samplesPerLevel = wholeRings;
    ScreenIndirectSettings oneLevel = allSamples;
    oneLevel.levels = 1;
    oneLevel.coverScreen = true;
    ScreenIndirectSettings full = oneLevel;
    full.start = StartResolution::full;
    full.smooth = false;
    std::vector<Ablation> steps;
    for (const auto& [name, meaning, settings] :
         {std::tuple{"too few samples", "a level's samples -> every texel of its ring", allSamples},
          std::tuple{"hierarchy", "levels -> the sum over every texel of the start resolution", oneLevel},
          std::tuple{"start resolution",
                     "start resolution, smoothing and upsampling -> every pixel's own sum over every pixel",
                     full}}) {
        auto without = configured(settings, presetOf(draft));
        if (!without) return without.error();
        steps.push_back({name, meaning, *std::move(without)});
    }
    return steps;
}

std::vector<Option> options() {
    return {
        {"preset", "NAME",
         "quarter-64, quarter-256, half-64, half-256: where gathering starts, and\n"
         "samples a level; each also with -5, for five levels instead of four.\n"
         "The options below replace its values (default: quarter-64)"},
        {"start", "WHERE", "resolution where gathering starts: full, half or quarter of each side"},
        {"levels", "N", "levels, each half as fine as the one before, 1 to 8"},
        {"radius", "R",
         "outer radius of every ring [texels of its level], 1 to 1024; auto: the\n"
         "smallest with which the outermost ring covers the screen\n"
         "(presets: 40 at 720 rows, in proportion elsewhere)"},
        {"samples", "N", "samples a pixel and level, 4 to 256; all: every texel of every ring"},
        {"reduce", "HOW",
         "which texel lends a coarser one its place and normal: nearest to the eye,\n"
         "or by voting (presets: voting)"},
        {"form-factor", "WHICH",
         "between disc and point, bounded; or between points, unbounded, for\n"
         "comparison: disc or point (presets: disc)"},
        {"minimum-cosine", "C", "a pixel's area is taken as if seen at no less, 0.001 to 1 (presets: 0.05)"},
        {"cover-screen", "SWITCH",
         "the outermost ring reaches the screen's corners, or ends at its radius: on or off\n"
         "(presets: on)"},
        {"smooth", "SWITCH", "a 3x3 filter at the start resolution: on or off (presets: on)"},
        {"only-level", "K", "show what this level alone contributes, 0 to levels - 1 (default: all)", false},
    };
}

} // namespace

Technique screenIndirect() {
    Technique technique;
    technique.name = "screen_indirect";
    technique.heading = "Screen-space indirect light";
    technique.options = options();
    technique.parse = parse;
    technique.ablations = ablations;
    technique.lastApproximation = {"disc form factor",
                                   "discs at pixel centres -> the exact integral over what the screen shows"};
    technique.examples = {{{"preset", "quarter-64"}}, {{"preset", "half-256-5"}}};
    return technique;
}

} // namespace rebound::techniques
