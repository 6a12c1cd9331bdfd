// SPDX-License-Identifier: MIT
#include "lab/images/exr_channels.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace rebound::lab {
namespace {

using Names = std::vector<std::string>;

// All channels; by their names without the layer's, where they have one layer in common.
struct Listed {
    Names all;
    std::map<std::string, std::string> byShortName;

    bool has(const Names& names) const {
        return std::all_of(names.begin(), names.end(),
                           [this](const std::string& name) { return byShortName.contains(name); });
    }
};

Listed listChannels(const Imf::ChannelList& channels) {
    Listed listed;
    std::set<std::string> layers;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string name = channel.name();
        const size_t dot = name.rfind('.');
        layers.insert(dot == std::string::npos ? "" : name.substr(0, dot));
        listed.all.push_back(name);
    }
    for (const std::string& name : listed.all)
        listed.byShortName[layers.size() == 1 ? name.substr(name.rfind('.') + 1) : name] = name;
    return listed;
}

std::string joined(const Names& names) {
    constexpr size_t most = 12;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), most); ++i)
        text += (i == 0 ? "" : ", ") + names[i].substr(0, 40);
    return text + (names.size() > most ? ", ..." : "");
}

const Names rgb = {"R", "G", "B"}, xyz = {"X", "Y", "Z"};

// The only one of these that there is, or, with no other channel, whatever it is called.
std::optional<std::string> soleChannel(const Listed& listed, const Names& candidates) {
    if (listed.byShortName.size() == 1) return listed.byShortName.begin()->first;
    std::optional<std::string> found;
    for (const std::string& name : candidates)
        if (listed.has({name})) {
            if (found) return std::nullopt;
            found = name;
        }
    return found;
}

// Short names; nothing where the channels do not say.
std::optional<Names> choose(const Listed& listed, ExrContent content) {
    const bool colors = listed.has(rgb), vectors = listed.has(xyz);
    const bool chroma = listed.has({"RY"}) || listed.has({"BY"}); // Y is then but a part of the picture
    switch (content) {
    case ExrContent::depth:
        if (colors || vectors || chroma) return std::nullopt;
        if (const auto sole = soleChannel(listed, {"Y", "Z", "V"})) return Names{*sole};
        return std::nullopt;
    case ExrContent::normal:
        if (colors == vectors) return std::nullopt;
        return colors ? rgb : xyz;
    case ExrContent::color:
        if (colors) return rgb;
        if (listed.has({"Y"}) && !vectors && !chroma) return Names{"Y"};
        return std::nullopt;
    case ExrContent::any:
        if (colors && vectors) return std::nullopt;
        if (colors) return listed.has({"A"}) ? Names{"R", "G", "B", "A"} : rgb;
        if (vectors) return xyz;
        if (chroma) return std::nullopt;
        if (const auto sole = soleChannel(listed, {"Y", "Z", "V"})) return Names{*sole};
        return std::nullopt;
    }
    return std::nullopt;
}

const char* expectation(ExrContent content) {
    switch (content) {
    case ExrContent::depth:
        return "depth in one channel, Y, Z or V";
    case ExrContent::normal:
        return "normals in either R, G, B or X, Y, Z";
    case ExrContent::color:
        return "colours in R, G, B, or grey in Y";
    default:
        return "one of Y, Z and V; R, G, B, with or without A; or X, Y, Z";
    }
}

} // namespace

Result<ExrChannels> chooseExrChannels(const Imf::ChannelList& channels, ExrContent content) {
    const Listed listed = listChannels(channels);
    const auto chosen = choose(listed, content);
    if (!chosen)
        return Error{ErrorCode::invalidData,
                     (listed.all.size() == 1 ? "its channel is " : "its channels are ") + joined(listed.all) +
                         "; expected " + expectation(content)};
    ExrChannels result;
    result.areColors = chosen->size() >= 3 && chosen->front() == "R";
    for (const std::string& shortName : *chosen) {
        const std::string& name = listed.byShortName.at(shortName);
        const Imf::Channel& channel = channels[name];
        if (channel.type != Imf::HALF && channel.type != Imf::FLOAT)
            return Error{ErrorCode::invalidData,
                         "channel " + name + " holds integers; expected half or float"};
        if (channel.xSampling != 1 || channel.ySampling != 1)
            return Error{ErrorCode::invalidData,
                         "channel " + name + " is subsampled; expected one value a pixel"};
        result.names.push_back(name);
    }
    for (const auto& [shortName, name] : listed.byShortName)
        if (std::find(result.names.begin(), result.names.end(), name) == result.names.end() &&
            shortName != "A")
            result.others.push_back(name);
    return result;
}

} // namespace rebound::lab
