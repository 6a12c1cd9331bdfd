// SPDX-License-Identifier: MIT
#include "lab/charts/point_store.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/files/json_reader.hpp"
#include "lab/files/json_text.hpp"
#include "lab/files/output_file.hpp"

#include <algorithm>
#include <cctype>
#include <span>
#include <system_error>

namespace rebound::charts {

namespace {

using lab::integerOf;
using lab::member;
using lab::textOf;

namespace fs = std::filesystem;

constexpr size_t largestPoint = size_t(1) << 20;

// FNV-1a: which point is meant is decided by the key itself, which the file holds too.
uint64_t hashOf(const std::string& text) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

Result<> createFolder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure)
        return Error{ErrorCode::inputOutput,
                     "cannot write to the folder " + folder.string() + ": " + failure.message()};
    return {};
}

std::vector<fs::path> jsonFilesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

Result<> removeAll(const fs::path& folder) {
    std::error_code failure;
    fs::remove_all(folder, failure);
    if (failure)
        return Error{ErrorCode::inputOutput, "cannot remove " + folder.string() + ": " + failure.message()};
    return {};
}

} // namespace

std::string fileNameOf(const std::string& text) {
    constexpr size_t longest = 80;
    std::string name;
    for (const char c : text.substr(0, longest))
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) name.push_back(c);
        else if (!name.empty() && name.back() != '-') name.push_back('-');
    while (!name.empty() && name.back() == '-') name.pop_back();
    return name.empty() ? "point" : name;
}

PointKey::PointKey(Json everything, const std::string& title) : key(std::move(everything)) {
    const std::string text = key.dump(-1, ' ', false, Json::error_handler_t::replace);
    char hash[20];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(hashOf(text)));
    name = fileNameOf(title) + "-" + hash;
}

Result<PointStore> PointStore::open(const fs::path& folder, const std::string& version, bool fresh) {
    PointStore store(folder, version);
    if (fresh)
        for (const char* name : {"points", "pictures"})
            if (auto removed = removeAll(folder / name); !removed) return removed.error();
    for (const char* name : {"points", "pictures"})
        if (auto created = createFolder(folder / name); !created) return created.error();
    for (const fs::path& file : jsonFilesIn(folder / "points"))
        if (auto done = store.read(file); !done) return done.error();
    return store;
}

Result<> PointStore::read(const fs::path& file) {
    const auto point = lab::guardInput(file, [&] {
        const std::vector<uint8_t> bytes = lab::readFileBytes(file, largestPoint, file);
        const nlohmann::json json = lab::parseJsonObject(
            {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "a finished point");
        const int format = integerOf(member(json, "format", "format"), "format", 0, 1 << 30);
        const std::string made = textOf(member(json, "version", "version"), "version");
        if (format != resultsFormat || made != version)
            lab::refuse("it is a result of Rebound " + made + " in format " + std::to_string(format) +
                        ", and this is " + version + " with format " + std::to_string(resultsFormat) +
                        "; --fresh starts over, and another --out keeps both");
        return std::pair(member(json, "key", "key"), pointFromJson(member(json, "point", "point")));
    });
    if (!point) return point.error();
    finished.emplace(file.stem().string(), *point);
    return {};
}

std::optional<Point> PointStore::find(const PointKey& wanted) const {
    const auto found = finished.find(wanted.name);
    // Text, because 0.05f as a key's number reads back as another type of JSON number.
    if (found == finished.end() || found->second.first.dump() != nlohmann::json(wanted.key).dump())
        return std::nullopt;
    std::error_code ignored;
    for (const char* end : {".png", "-error.png", "-small.png", "-error-small.png"})
        if (!fs::is_regular_file(picturePath(wanted.name + end), ignored)) return std::nullopt;
    return found->second.second;
}

Result<> PointStore::save(const PointKey& key, const Point& point, const PointPictures& pictures) const {
    const std::pair<const char*, const lab::Picture*> files[] = {{".png", &pictures.shown},
                                                                 {"-error.png", &pictures.error},
                                                                 {"-small.png", &pictures.smallShown},
                                                                 {"-error-small.png", &pictures.smallError}};
    for (const auto& [end, picture] : files)
        if (auto written = lab::writePng(picturePath(key.name + end), *picture); !written) return written;
    const fs::path base = folder / "points" / key.name;
    if (auto written = lab::writeExr(base.string() + ".exr", pictures.light); !written) return written;
    const Json json = {
        {"format", resultsFormat}, {"version", version}, {"key", key.key}, {"point", toJson(point)}};
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    return lab::writeFile(base.string() + ".json", std::as_bytes(std::span(text)));
}

} // namespace rebound::charts
