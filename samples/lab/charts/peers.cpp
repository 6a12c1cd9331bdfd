// SPDX-License-Identifier: MIT
#include "lab/charts/peers.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/files/json_reader.hpp"
#include "lab/files/json_text.hpp"
#include "lab/images/image_files.hpp"
#include "lab/measure/run_values.hpp"

#include <algorithm>
#include <system_error>

namespace rebound::charts {

namespace {

using lab::checkKeys;
using lab::integerOf;
using lab::member;
using lab::refuseValue;
using lab::shortText;
using lab::textOf;

namespace fs = std::filesystem;

constexpr size_t largestFile = size_t(1) << 20;

std::string sizeText(Extent2D size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

std::string viewOf(const std::string& scene, const std::string& camera, const std::vector<View>& views) {
    std::string charted;
    for (const View& view : views) {
        if (view.scene == scene && view.camera.name == camera) return view.label;
        charted += (charted.empty() ? "" : ", ") + view.scene + " " + view.camera.name;
    }
    lab::refuse("scene and camera are \"" + scene + "\" and \"" + camera +
                "\"; one of those that are charted, " + charted + ", was expected");
}

Point pointFrom(const nlohmann::json& json, const std::vector<View>& views, Extent2D size) {
    checkKeys(json, "",
              {"format", "name", "technique", "settings", "scene", "camera", "size", "time_ms", "machine"});
    integerOf(member(json, "format", "format"), "format", 1, 1);
    const auto text = [&](const char* key) { return textOf(member(json, key, key), key); };
    const auto made = measure::parseSize("size", text("size"));
    if (!made) lab::refuse(made.error().message);
    if (*made != size)
        lab::refuse("size is " + sizeText(*made) + "; the chart's, " + sizeText(size) + ", was expected");
    Point point;
    point.isPeer = true;
    point.backend = text("name");
    point.technique = text("technique");
    point.settings = json.contains("settings") ? Json(json["settings"]) : Json::object();
    if (!point.settings.is_object()) refuseValue("settings", json["settings"], "an object");
    point.name = point.backend;
    for (const auto& [key, value] : point.settings.items())
        point.name += " " + key + " " + (value.is_string() ? value.get<std::string>() : shortText(value));
    point.view = viewOf(text("scene"), text("camera"), views);
    point.machine = text("machine");
    point.device = point.machine;
    point.times = timesFromJson(member(json, "time_ms", "time_ms"), "time_ms");
    return point;
}

Result<Peer> readPeer(const fs::path& folder, const std::vector<View>& views, Extent2D size) {
    Peer peer;
    peer.folder = folder;
    const fs::path description = folder / "peer.json", picture = folder / "indirect.exr";
    std::error_code ignored;
    for (const fs::path& file : {description, picture})
        if (!fs::is_regular_file(file, ignored))
            return Error{ErrorCode::notFound,
                         file.string() + " is missing; a peer is a folder with peer.json and indirect.exr"};
    auto point = lab::guardInput(description, [&] {
        const std::vector<uint8_t> bytes = lab::readFileBytes(description, largestFile, description);
        return pointFrom(
            lab::parseJsonObject({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "a peer"),
            views, size);
    });
    if (!point) return point.error();
    peer.point = *std::move(point);
    auto light = lab::readExr(picture);
    if (!light) return light.error();
    if (light->extent() != size || light->channels < 3)
        return Error{ErrorCode::invalidData, "'" + picture.string() + "': it is " +
                                                 sizeText(light->extent()) + " with " +
                                                 std::to_string(light->channels) + " channels; " +
                                                 sizeText(size) + " with R, G, B was expected"};
    peer.light = lab::Image(size, 3);
    for (size_t i = 0; i < peer.light.data.size(); ++i)
        peer.light.data[i] = light->data[i / 3 * size_t(light->channels) + i % 3];
    return peer;
}

} // namespace

Result<std::vector<Peer>> readPeers(const fs::path& folder, const std::vector<View>& views, Extent2D size) {
    std::error_code failure;
    std::vector<fs::path> folders;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure))
        if (entry->is_directory(failure)) folders.push_back(entry->path());
    if (failure)
        return Error{ErrorCode::notFound,
                     "cannot read the folder of peers " + folder.string() + ": " + failure.message()};
    if (folders.empty())
        return Error{ErrorCode::notFound, "the folder of peers " + folder.string() +
                                              " holds no folder; one for each peer was expected"};
    std::sort(folders.begin(), folders.end());
    std::vector<Peer> peers;
    for (const fs::path& one : folders) {
        auto peer = readPeer(one, views, size);
        if (!peer) return peer.error();
        peers.push_back(*std::move(peer));
    }
    return peers;
}

} // namespace rebound::charts
