// SPDX-License-Identifier: MIT
#include "lab/charts/embedded_text.hpp"
#include "lab/charts/report.hpp"
#include "lab/files/file_bytes.hpp"
#include "lab/files/input_error.hpp"

#include <algorithm>
#include <map>

namespace rebound::charts {

namespace {

namespace fs = std::filesystem;

constexpr size_t largestPicture = size_t(16) << 20;

// Each distinct picture once; who shows it has its place in the list.
class PictureList {
public:
    explicit PictureList(fs::path where) : folder(std::move(where)) {}

    // Throws lab::InputError.
    size_t add(const std::string& name) {
        const fs::path file = folder / name;
        const std::vector<uint8_t> bytes = lab::readFileBytes(file, largestPicture, fs::path());
        std::string text = base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        const auto [place, isNew] = index.emplace(std::move(text), list.size());
        if (isNew) list.push_back(place->first);
        return place->second;
    }

    const Json& json() const { return list; }

private:
    fs::path folder;
    Json list = Json::array();
    std::map<std::string, size_t> index;
};

Json pageData(const Results& results, const fs::path& folder) {
    Json json = toJson(results);
    PictureList pictures(folder);
    for (Json& view : json["views"])
        view["picture_index"] = pictures.add(view["picture"].get<std::string>() + "-small.png");
    for (Json& point : json["points"]) {
        const auto name = point["picture"].get<std::string>();
        point["picture_index"] = pictures.add(name + "-small.png");
        point["error_index"] = pictures.add(name + "-error-small.png");
    }
    json["pictures"] = pictures.json();
    return json;
}

// The text with its marks replaced; what is put in is not searched for marks.
std::string fill(std::string_view text, const std::map<std::string_view, std::string_view>& values) {
    std::string filled;
    for (size_t at = 0; at < text.size();) {
        const auto mark = text[at] == '@' ? text.find('@', at + 1) : std::string_view::npos;
        const auto value =
            mark == std::string_view::npos ? values.end() : values.find(text.substr(at, mark + 1 - at));
        if (value != values.end()) {
            filled += value->second;
            at = mark + 1;
        } else {
            filled += text[at++];
        }
    }
    return filled;
}

} // namespace

std::string jsonForScript(const Json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
        if (c == '<') // in texts alone
            text += "\\u003c";
        else text += c;
    return text;
}

std::string base64(std::string_view bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

Result<std::string> resultsPage(const Results& results, const fs::path& pictures) {
    const auto data = lab::guardInput(pictures, [&] { return jsonForScript(pageData(results, pictures)); });
    if (!data) return data.error();
    return fill(embedded::pageTemplate, {{"@STYLE@", embedded::pageStyle},
                                         {"@RESULTS@", *data},
                                         {"@LIBRARY@", embedded::chartLibrary},
                                         {"@MODEL@", embedded::pageModel},
                                         {"@CHART@", embedded::pageChart},
                                         {"@SCRIPT@", embedded::pageScript}});
}

} // namespace rebound::charts
