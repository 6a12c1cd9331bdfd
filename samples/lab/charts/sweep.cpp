// SPDX-License-Identifier: MIT
#include "lab/charts/sweep.hpp"

#include "lab/charts/embedded_text.hpp"
#include "lab/charts/json_reader.hpp"
#include "lab/files/file_bytes.hpp"
#include "lab/files/json_text.hpp"

#include <algorithm>
#include <set>

namespace rebound::charts {

namespace {

using Value = nlohmann::json;

constexpr size_t largestFile = size_t(1) << 20;
constexpr size_t mostSettings = 10000;
constexpr int mostFrames = 100000;

int wholeNumber(const Value& value, const std::string& where) {
    return integerOf(value, where, -1000000, 1000000); // planScreenIndirect() knows each setting's range
}

std::string samplesText(const Value& value, const std::string& where) {
    return value.is_string() ? textOf(value, where) : std::to_string(wholeNumber(value, where));
}

std::string radiusText(const Value& value, const std::string& where) {
    if (value.is_string()) return textOf(value, where);
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", numberOf(value, where, 1.0, 1024.0));
    return text;
}

void assign(measure::SettingsDraft& draft, const std::string& key, const Value& value,
            const std::string& where) {
    if (key == "preset") draft.preset = textOf(value, where);
    else if (key == "start") draft.start = textOf(value, where);
    else if (key == "reduce") draft.reduction = textOf(value, where);
    else if (key == "form_factor") draft.formFactor = textOf(value, where);
    else if (key == "smooth") draft.smooth = textOf(value, where);
    else if (key == "cover_screen") draft.coverScreen = textOf(value, where);
    else if (key == "radius") draft.radius = radiusText(value, where);
    else if (key == "levels") draft.levels = wholeNumber(value, where);
    else if (key == "samples") draft.samples = samplesText(value, where);
    else draft.minimumCosine = float(numberOf(value, where, 0.001, 1.0));
}

// Every combination of an object's arrays.
std::vector<measure::SettingsDraft> draftsOf(const Value& object, const std::string& where) {
    checkKeys(object, where,
              {"preset", "start", "levels", "samples", "radius", "reduce", "form_factor", "minimum_cosine",
               "cover_screen", "smooth"});
    std::vector<measure::SettingsDraft> drafts = {{}};
    for (const auto& [key, value] : object.items()) {
        const std::string place = where + "." + key;
        const Value values = value.is_array() ? arrayOf(value, place) : Value::array({value});
        if (drafts.size() * values.size() > mostSettings)
            lab::refuse(where + " has more than " + std::to_string(mostSettings) + " combinations");
        std::vector<measure::SettingsDraft> combined;
        for (const measure::SettingsDraft& draft : drafts)
            for (const Value& one : values) {
                combined.push_back(draft);
                assign(combined.back(), key, one, place);
            }
        drafts = std::move(combined);
    }
    return drafts;
}

Setting settingFrom(const measure::SettingsDraft& draft, Extent2D size, const std::string& where) {
    Setting setting;
    const auto settings = measure::settingsOf(draft, size, measure::Spelling::keys);
    if (!settings) lab::refuse(where + "." + settings.error().message);
    if (const auto plan = measure::planOf(*settings, measure::Spelling::keys); !plan)
        lab::refuse(where + "." + plan.error().message);
    setting.settings = *settings;
    setting.preset = draft.preset;
    setting.name = nameOfSettings(*settings);
    return setting;
}

std::vector<Setting> readSettings(const Value& techniques, Extent2D size) {
    checkKeys(techniques, "techniques", {"screen_indirect"});
    const std::string where = "techniques.screen_indirect";
    const Value& list = arrayOf(member(techniques, "screen_indirect", where), where);
    std::vector<Setting> settings;
    std::set<std::string> known;
    for (size_t i = 0; i < list.size(); ++i) {
        const std::string place = where + "[" + std::to_string(i) + "]";
        for (const measure::SettingsDraft& draft : draftsOf(list[i], place))
            if (Setting setting = settingFrom(draft, size, place); known.insert(setting.name).second)
                settings.push_back(std::move(setting));
        if (settings.size() > mostSettings)
            lab::refuse(where + " has more than " + std::to_string(mostSettings) + " settings");
    }
    return settings;
}

SceneChoice readScene(const Value& value, const std::string& where) {
    if (value.is_string()) return {textOf(value, where), "", {}};
    checkKeys(value, where, {"scene", "view", "cameras"});
    SceneChoice choice;
    choice.scene = textOf(member(value, "scene", where + ".scene"), where + ".scene");
    if (value.contains("view")) choice.viewFile = textOf(value["view"], where + ".view");
    if (value.contains("cameras"))
        for (const Value& camera : arrayOf(value["cameras"], where + ".cameras"))
            choice.cameras.push_back(textOf(camera, where + ".cameras"));
    return choice;
}

ReferenceChoice readReference(const Value& value) {
    checkKeys(value, "reference", {"bounces", "samples", "error"});
    ReferenceChoice choice;
    if (value.contains("bounces")) choice.bounces = integerOf(value["bounces"], "reference.bounces", 1, 64);
    if (value.contains("samples"))
        choice.samples = integerOf(value["samples"], "reference.samples", 1, 1 << 20);
    if (value.contains("error")) choice.error = numberOf(value["error"], "reference.error", 0.0, 1.0);
    return choice;
}

Extent2D readSize(const Value& value) {
    const auto size = measure::parseSize("size", textOf(value, "size"));
    if (!size) lab::refuse(size.error().message);
    return *size;
}

Sweep readSweepObject(const Value& root, std::optional<Extent2D> size) {
    checkKeys(root, "", {"techniques", "backends", "scenes", "size", "frames", "warm_up", "reference"});
    Sweep sweep;
    if (root.contains("size")) sweep.size = readSize(root["size"]);
    sweep.size = size.value_or(sweep.size);
    if (root.contains("backends")) {
        sweep.backends.clear();
        for (const Value& backend : arrayOf(root["backends"], "backends"))
            sweep.backends.push_back(textOf(backend, "backends"));
    }
    if (root.contains("scenes")) {
        sweep.scenes.clear();
        const Value& scenes = arrayOf(root["scenes"], "scenes");
        for (size_t i = 0; i < scenes.size(); ++i)
            sweep.scenes.push_back(readScene(scenes[i], "scenes[" + std::to_string(i) + "]"));
    }
    if (root.contains("frames")) sweep.frames = integerOf(root["frames"], "frames", 1, mostFrames);
    if (root.contains("warm_up")) sweep.warmUp = integerOf(root["warm_up"], "warm_up", 0, mostFrames);
    if (root.contains("reference")) sweep.reference = readReference(root["reference"]);
    sweep.settings = readSettings(member(root, "techniques", "techniques"), sweep.size);
    return sweep;
}

} // namespace

std::string nameOfSettings(const ScreenIndirectSettings& s) {
    std::string name = std::string(measure::nameOf(s.start)) + "-" + measure::samplesText(s);
    const auto usual = screenIndirectPreset("quarter-64", s.resolution);
    if (s.levels != 4) name.append("-").append(std::to_string(s.levels));
    if (s.reduction != Reduction::voting) name += std::string(" ") + measure::nameOf(s.reduction);
    if (s.formFactor != FormFactor::pointToDisc)
        name += std::string(" form factor ") + measure::nameOf(s.formFactor);
    const auto number = [](float value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.6g", double(value));
        return std::string(text);
    };
    if (usual && s.ringRadius != usual->ringRadius) name += " radius " + number(s.ringRadius);
    if (usual && s.minimumCosine != usual->minimumCosine)
        name += " minimum cosine " + number(s.minimumCosine);
    if (!s.coverScreen) name += " not covering";
    if (!s.smooth) name += " not smoothed";
    return name;
}

Result<Sweep> parseSweep(std::string_view text, const std::string& name, std::optional<Extent2D> size) {
    return lab::guardInput(name,
                           [&] { return readSweepObject(lab::parseJsonObject(text, "a sweep"), size); });
}

Result<Sweep> readSweep(const std::filesystem::path& file, std::optional<Extent2D> size) {
    return lab::guardInput(file, [&] {
        const std::vector<uint8_t> bytes = lab::readFileBytes(file, largestFile, file);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return readSweepObject(lab::parseJsonObject(text, "a sweep"), size);
    });
}

Json toJson(const ReferenceChoice& reference) {
    return {{"bounces", reference.bounces}, {"samples", reference.samples}, {"error", reference.error}};
}

Json toJson(const Sweep& sweep) {
    Json json = {{"techniques", Json::object()}, {"backends", sweep.backends}, {"scenes", Json::array()}};
    for (const Setting& setting : sweep.settings)
        json["techniques"][setting.technique].push_back(
            measure::settingsToJson(setting.settings, setting.preset));
    for (const SceneChoice& choice : sweep.scenes) {
        Json scene = {{"scene", choice.scene}};
        if (!choice.viewFile.empty()) scene["view"] = choice.viewFile;
        if (!choice.cameras.empty()) scene["cameras"] = choice.cameras;
        json["scenes"].push_back(scene);
    }
    json["size"] = std::to_string(sweep.size.width) + "x" + std::to_string(sweep.size.height);
    json["frames"] = sweep.frames;
    json["warm_up"] = sweep.warmUp;
    json["reference"] = toJson(sweep.reference);
    return json;
}

std::string_view defaultSweepText() { return embedded::defaultSweep; }

} // namespace rebound::charts
