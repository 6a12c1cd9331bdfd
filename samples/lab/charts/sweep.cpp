// SPDX-License-Identifier: MIT
#include "lab/charts/sweep.hpp"

#include "lab/charts/embedded_text.hpp"
#include "lab/files/file_bytes.hpp"
#include "lab/files/json_reader.hpp"
#include "lab/files/json_text.hpp"
#include "lab/measure/run_values.hpp"

#include <algorithm>
#include <set>

namespace rebound::charts {

namespace {

using lab::arrayOf;
using lab::checkKeys;
using lab::integerOf;
using lab::member;
using lab::numberOf;
using lab::refuseValue;
using lab::textOf;

using Value = nlohmann::json;

constexpr size_t largestFile = size_t(1) << 20;
constexpr size_t mostSettings = 10000;
constexpr int mostFrames = 100000;

// As a command line has it.
std::string draftText(const Value& value, const std::string& where) {
    if (value.is_string()) return textOf(value, where);
    if (!value.is_number()) refuseValue(where, value, "a text or a number");
    if (value.is_number_integer()) return std::to_string(value.get<int64_t>());
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value.get<double>());
    return text;
}

const techniques::Option* findOption(const techniques::Technique& technique, const std::string& key) {
    for (const techniques::Option& option : technique.options)
        if (option.isSetting && techniques::spelled(option.name, techniques::Spelling::keys) == key)
            return &option;
    return nullptr;
}

std::vector<std::string> keysOf(const techniques::Technique& technique) {
    std::vector<std::string> keys;
    for (const techniques::Option& option : technique.options)
        if (option.isSetting) keys.push_back(techniques::spelled(option.name, techniques::Spelling::keys));
    return keys;
}

// Every combination of an object's arrays.
std::vector<techniques::Draft> draftsOf(const techniques::Technique& technique, const Value& object,
                                        const std::string& where) {
    checkKeys(object, where, keysOf(technique));
    std::vector<techniques::Draft> drafts = {{}};
    for (const auto& [key, value] : object.items()) {
        const std::string place = where + "." + key;
        const Value values = value.is_array() ? arrayOf(value, place) : Value::array({value});
        if (drafts.size() * values.size() > mostSettings)
            lab::refuse(where + " has more than " + std::to_string(mostSettings) + " combinations");
        std::vector<techniques::Draft> combined;
        for (const techniques::Draft& draft : drafts)
            for (const Value& one : values) {
                combined.push_back(draft);
                combined.back()[findOption(technique, key)->name] = draftText(one, place);
            }
        drafts = std::move(combined);
    }
    return drafts;
}

Setting settingFrom(const techniques::Technique& technique, const techniques::Draft& draft, Extent2D size,
                    const std::string& where) {
    auto configured = technique.parse(draft, {size}, techniques::Spelling::keys);
    if (!configured) lab::refuse(where + "." + configured.error().message);
    const std::string name = configured->name;
    return {&technique, draft, *std::move(configured), name};
}

std::vector<Setting> readSettings(const techniques::Technique& technique, const Value& list, Extent2D size) {
    const std::string where = "techniques." + technique.name;
    arrayOf(list, where);
    std::vector<Setting> settings;
    std::set<std::string> known;
    for (size_t i = 0; i < list.size(); ++i) {
        const std::string place = where + "[" + std::to_string(i) + "]";
        for (const techniques::Draft& draft : draftsOf(technique, list[i], place))
            if (Setting setting = settingFrom(technique, draft, size, place);
                known.insert(setting.name).second)
                settings.push_back(std::move(setting));
        if (settings.size() > mostSettings)
            lab::refuse(where + " has more than " + std::to_string(mostSettings) + " settings");
    }
    return settings;
}

// In the order in which the lab knows the techniques.
std::vector<Setting> readSettings(const Value& object, Extent2D size) {
    std::vector<std::string> names;
    for (const techniques::Technique& technique : techniques::all()) names.push_back(technique.name);
    checkKeys(object, "techniques", names);
    if (object.empty()) refuseValue("techniques", object, "an object with some of " + techniques::names());
    std::vector<Setting> settings;
    for (const techniques::Technique& technique : techniques::all())
        if (object.contains(technique.name))
            for (Setting& setting : readSettings(technique, object[technique.name], size)) {
                if (object.size() > 1) setting.name.insert(0, technique.name + " ");
                settings.push_back(std::move(setting));
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

Result<techniques::Configured> Setting::forCamera(const lab::CameraView& camera, Extent2D size) const {
    return technique->parse(draft,
                            {size, camera.orthographic ? Projection::orthographic : Projection::perspective},
                            techniques::Spelling::keys);
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
        json["techniques"][setting.technique->name].push_back(setting.configured.settings);
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
