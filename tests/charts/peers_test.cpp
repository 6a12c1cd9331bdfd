// SPDX-License-Identifier: MIT
#include "../lab/temporary_folder.hpp"
#include "lab/images/image_files.hpp"
#include "made_workshop.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <functional>

namespace rebound::charts {
namespace {

namespace fs = std::filesystem;

nlohmann::json description() {
    return {{"format", 1},
            {"name", "rival"},
            {"technique", "voxel cones"},
            {"settings", {{"cones", 6}}},
            {"scene", "builtin:box"},
            {"camera", "side"},
            {"size", "8x4"},
            {"time_ms", {{"median", 4.0}, {"p10", 3.0}, {"p90", 6.0}}},
            {"machine", "another processor"}};
}

void writePeer(const fs::path& folder, const nlohmann::json& json, const lab::Image& light) {
    fs::create_directories(folder);
    lab::writeText(folder / "peer.json", json.dump());
    REQUIRE(lab::writeExr(folder / "indirect.exr", light, lab::ExrPrecision::full));
}

lab::Image lightOf(Extent2D size) { return {size, 3, 2.2f}; }

TEST_CASE("peers become points of the view that they name, held against the same truth") {
    const lab::TemporaryFolder folder;
    writePeer(folder / "peers" / "rival", description(), lightOf({8, 4}));
    const Sweep sweep = madeSweep();
    const std::vector<View> views = madeViews();
    const auto peers = readPeers(folder / "peers", views, sweep.size);
    REQUIRE_MESSAGE(peers, peers.error().message);
    MadeWorkshop workshop(sweep.size);
    std::vector<ChartBackend> backends = madeBackends();
    for (int run = 0; run < 2; ++run) { // the second takes all other points from the first
        auto store = PointStore::open(folder / "out", REBOUND_VERSION, false);
        REQUIRE(store);
        const auto results =
            runChart({sweep, views, backends, *peers, "a machine", "half"}, workshop, *store);
        REQUIRE_MESSAGE(results, results.error().message);
        REQUIRE(results->points.size() == 5);
        const Point& point = results->points.back();
        CHECK(point.isPeer);
        CHECK(point.view == "box side");
        CHECK(point.name == "rival cones 6");
        CHECK(point.technique == "voxel cones");
        CHECK(point.machine == "another processor");
        CHECK(point.times.median == 4.0);
        CHECK(point.times.minimum == 3.0); // at least as small as the 10th percentile
        // 2.2 in place of 2, over a mean of 2; floats carry seven digits.
        CHECK(point.metrics.relativeRmse == doctest::Approx(0.1).epsilon(1e-5));
    }
    CHECK(workshop.measured.size() == 4);
}

TEST_CASE("a peer's alpha is dropped") {
    const lab::TemporaryFolder folder;
    lab::Image light({8, 4}, 4, 1.0f);
    light.at(3, 2)[1] = 5.0f;
    writePeer(folder / "rival", description(), light);
    const auto peers = readPeers(folder.path(), madeViews(), {8, 4});
    REQUIRE_MESSAGE(peers, peers.error().message);
    CHECK((*peers)[0].light.channels == 3);
    CHECK((*peers)[0].light.at(3, 2)[1] == 5.0f);
    CHECK((*peers)[0].light.at(3, 2)[2] == 1.0f);
}

struct BadPeer {
    const char* name;
    std::function<void(nlohmann::json&)> change;
    std::initializer_list<const char*> says;
};

TEST_CASE("descriptions with missing, unknown or impossible values are refused in one sentence") {
    const BadPeer all[] = {
        {"no name", [](nlohmann::json& j) { j.erase("name"); }, {"name is missing"}},
        {"unknown key", [](nlohmann::json& j) { j["speed"] = 1; }, {"\"speed\"", "time_ms"}},
        {"format", [](nlohmann::json& j) { j["format"] = 2; }, {"format is 2"}},
        {"no time", [](nlohmann::json& j) { j["time_ms"].erase("median"); }, {"time_ms.median is missing"}},
        {"time 0", [](nlohmann::json& j) { j["time_ms"]["median"] = 0; }, {"time_ms.median is 0"}},
        {"time text", [](nlohmann::json& j) { j["time_ms"] = "fast"; }, {"time_ms is \"fast\"", "an object"}},
        {"order", [](nlohmann::json& j) { j["time_ms"]["p10"] = 5.0; }, {"time_ms", "p10 <= median"}},
        {"scene", [](nlohmann::json& j) { j["scene"] = "palace"; }, {"palace", "builtin:box front"}},
        {"camera", [](nlohmann::json& j) { j["camera"] = "top"; }, {"top", "builtin:box side"}},
        {"size", [](nlohmann::json& j) { j["size"] = "16x8"; }, {"16x8", "8x4"}},
        {"size text", [](nlohmann::json& j) { j["size"] = "big"; }, {"size is \"big\""}},
        {"settings", [](nlohmann::json& j) { j["settings"] = 3; }, {"settings is 3", "an object"}},
        {"machine", [](nlohmann::json& j) { j["machine"] = ""; }, {"machine is \"\""}},
    };
    for (const BadPeer& bad : all) {
        INFO("peer: ", bad.name);
        const lab::TemporaryFolder folder;
        nlohmann::json json = description();
        bad.change(json);
        writePeer(folder / "rival", json, lightOf({8, 4}));
        const auto peers = readPeers(folder.path(), madeViews(), {8, 4});
        REQUIRE(!peers);
        INFO("it says: ", peers.error().message);
        CHECK(peers.error().message.find("peer.json") != std::string::npos);
        for (const char* text : bad.says) CHECK(peers.error().message.find(text) != std::string::npos);
    }
}

TEST_CASE("missing folders and files, and pictures of another size, are one sentence each") {
    const lab::TemporaryFolder folder;
    const auto messageOf = [&](const fs::path& path) {
        const auto peers = readPeers(path, madeViews(), {8, 4});
        REQUIRE(!peers);
        return peers.error().message;
    };
    CHECK(messageOf(folder / "nowhere").find("nowhere") != std::string::npos);
    CHECK(messageOf(folder.path()).find("holds no folder") != std::string::npos);
    fs::create_directories(folder / "rival");
    CHECK(messageOf(folder.path()).find("peer.json is missing") != std::string::npos);
    lab::writeText(folder / "rival" / "peer.json", description().dump());
    CHECK(messageOf(folder.path()).find("indirect.exr is missing") != std::string::npos);
    writePeer(folder / "rival", description(), lightOf({8, 5}));
    CHECK(messageOf(folder.path()).find("8x5 with 3 channels; 8x4") != std::string::npos);
    writePeer(folder / "rival", description(), lab::Image({8, 4}, 1));
    CHECK(messageOf(folder.path()).find("1 channels") != std::string::npos);
    lab::writeText(folder / "rival" / "indirect.exr", "not a picture");
    CHECK(messageOf(folder.path()).find("indirect.exr") != std::string::npos);
}

} // namespace
} // namespace rebound::charts
