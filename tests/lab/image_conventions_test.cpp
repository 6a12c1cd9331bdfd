// SPDX-License-Identifier: MIT
// Channels, windows and primaries of OpenEXR files by other programs: understood, or refused by name.
#include "exr_draft.hpp"

#include "lab/images/image_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

using namespace rebound;
using namespace rebound::lab;

namespace {

Result<Image> written(ExrDraft draft, const ExrReading& reading = {}) {
    const TemporaryFolder folder;
    draft.write(folder / "a.exr");
    return readExr(folder / "a.exr", reading);
}

Image read(const ExrDraft& draft, const ExrReading& reading = {}) {
    const auto image = written(draft, reading);
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return *image;
}

void checkRefused(const ExrDraft& draft, ExrContent content, const std::string& text) {
    const auto image = written(draft, {content});
    REQUIRE(!image);
    INFO(image.error().message);
    CHECK(image.error().message.find("a.exr: ") != std::string::npos);
    CHECK(image.error().message.find(text) != std::string::npos);
}

ExrDraft with(const std::map<std::string, float>& channels) {
    ExrDraft draft;
    for (const auto& [name, value] : channels) draft.constant(name, value);
    return draft;
}

std::vector<float> firstPixel(const Image& image) {
    return {image.data.begin(), image.data.begin() + image.channels};
}

const std::map<std::string, float> xyz = {{"X", 0.6f}, {"Y", 0.0f}, {"Z", 0.8f}};
const std::map<std::string, float> rgb = {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}};

} // namespace

TEST_CASE("normals are three channels, called by axes or by colours") {
    for (const ExrContent content : {ExrContent::any, ExrContent::normal})
        CHECK(firstPixel(read(with(xyz), {content})) == std::vector<float>{0.6f, 0.0f, 0.8f});
    CHECK(firstPixel(read(with(rgb), {ExrContent::normal})) == std::vector<float>{1, 2, 3});
    checkRefused(with({{"Y", 1}}), ExrContent::normal,
                 "its channel is Y; expected normals in either R, G, B or X, Y, Z");
    std::map<std::string, float> both = xyz;
    both.insert(rgb.begin(), rgb.end());
    checkRefused(with(both), ExrContent::normal, "its channels are B, G, R, X, Y, Z; expected");
    checkRefused(with(both), ExrContent::any, "its channels are B, G, R, X, Y, Z; expected");
}

TEST_CASE("depth is one channel, whose name leaves nothing open") {
    for (const char* name : {"Y", "Z", "V", "depth", "View Layer.Depth.Z"})
        CHECK(firstPixel(read(with({{name, 5}}), {ExrContent::depth})) == std::vector<float>{5});
    CHECK(firstPixel(read(with({{"Z", 5}, {"mask", 1}}), {ExrContent::depth})) == std::vector<float>{5});
    checkRefused(with({{"Y", 4}, {"Z", 5}}), ExrContent::depth,
                 "its channels are Y, Z; expected depth in one channel");
    checkRefused(with({{"Y", 4}, {"Z", 5}}), ExrContent::any, "its channels are Y, Z; expected one of");
    checkRefused(with(rgb), ExrContent::depth, "its channels are B, G, R");
    checkRefused(with(xyz), ExrContent::depth, "its channels are X, Y, Z");
}

TEST_CASE("colours are red, green and blue, or grey") {
    CHECK(firstPixel(read(with(rgb), {ExrContent::color})) == std::vector<float>{1, 2, 3});
    CHECK(firstPixel(read(with({{"Y", 4}}), {ExrContent::color})) == std::vector<float>{4});
    std::map<std::string, float> more = rgb;
    more.insert({{"A", 1.0f}, {"Z", 9.0f}});
    std::vector<std::string> notes;
    CHECK(firstPixel(read(with(more), {ExrContent::color, 0.0f, &notes})) == std::vector<float>{1, 2, 3});
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("its channels Z are left out") != std::string::npos);
    CHECK(firstPixel(read(with(more))) == std::vector<float>{1, 2, 3, 1});
    checkRefused(with(xyz), ExrContent::color, "its channels are X, Y, Z; expected colours");
    checkRefused(with({{"Z", 4}}), ExrContent::color, "its channel is Z; expected colours");
    checkRefused(with({{"Y", 1}, {"RY", 0}, {"BY", 0}}), ExrContent::any, "its channels are BY, RY, Y");
}

TEST_CASE("one layer's name counts for nothing, two layers are refused by name") {
    CHECK(firstPixel(read(with({{"front.R", 1}, {"front.G", 2}, {"front.B", 3}}))) ==
          std::vector<float>{1, 2, 3});
    checkRefused(with({{"a.R", 1}, {"a.G", 2}, {"a.B", 3}, {"b.R", 1}, {"b.G", 2}, {"b.B", 3}}),
                 ExrContent::color, "its channels are a.B, a.G, a.R, b.B, b.G, b.R; expected");
}

TEST_CASE("a picture has the size of its display window, and is where its data window says") {
    ExrDraft draft;
    draft.displayWindow = {{0, 0}, {3, 2}};
    draft.dataWindow = {{1, -1},
                        {4, 1}}; // beyond the right and upper edges, short of the left and lower ones
    draft.channels["Y"] = {10, 11, 12, 13, 20, 21, 22, 23, 30, 31, 32, 33};
    std::vector<std::string> notes;
    const Image image = read(draft, {ExrContent::any, -1.0f, &notes});
    REQUIRE(image.extent() == Extent2D{4, 3});
    CHECK(image.data == std::vector<float>{-1, 20, 21, 22, -1, 30, 31, 32, -1, -1, -1, -1});
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("1, -1 to 4, 1") != std::string::npos);
    CHECK(notes[0].find("0, 0 to 3, 2") != std::string::npos);

    // The two windows moved together are the same picture.
    notes.clear();
    draft.displayWindow = draft.dataWindow = {{-7, 5}, {-4, 7}};
    CHECK(read(draft, {ExrContent::any, -1.0f, &notes}).data == draft.channels["Y"]);
    CHECK(notes.empty());

    draft.displayWindow = {{0, 0}, {3, 2}};
    checkRefused(draft, ExrContent::any, "its data window lies outside its display window");
}

TEST_CASE("pixels that are no squares are named") {
    ExrDraft draft = with({{"Y", 1}});
    draft.pixelAspectRatio = 2.0f;
    std::vector<std::string> notes;
    read(draft, {ExrContent::any, 0.0f, &notes});
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("2.000000 times as wide as high") != std::string::npos);
}

TEST_CASE("colours of other primaries become those of Rec. 709, white staying white") {
    // Rec. 2020 with the same white: the matrix of ITU-R BT.2087, rounded to four digits there.
    ExrDraft draft = with(rgb);
    draft.primaries = {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f};
    std::vector<std::string> notes;
    const std::vector<float> wide = firstPixel(read(draft, {ExrContent::color, 0.0f, &notes}));
    CHECK(double(wide[0]) == doctest::Approx(1.6605 - 2 * 0.5876 - 3 * 0.0728).epsilon(0.001).scale(1));
    CHECK(double(wide[1]) == doctest::Approx(-0.1246 + 2 * 1.1329 - 3 * 0.0083).epsilon(0.001).scale(1));
    CHECK(double(wide[2]) == doctest::Approx(-0.0182 - 2 * 0.1006 + 3 * 1.1187).epsilon(0.001).scale(1));
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("converted to Rec. 709") != std::string::npos);

    // ACES AP0, of another white: grey is the same grey.
    draft = with({{"R", 0.5f}, {"G", 0.5f}, {"B", 0.5f}, {"A", 0.25f}});
    draft.primaries = {0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.077f, 0.32168f, 0.33767f};
    const std::vector<float> grey = firstPixel(read(draft));
    for (size_t c = 0; c < 3; ++c) CHECK(double(grey[c]) == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(grey[3] == 0.25f);

    // Rec. 709's own say nothing new; vectors have no primaries.
    draft = with(rgb);
    draft.primaries = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    CHECK(firstPixel(read(draft)) == std::vector<float>{1, 2, 3});
    draft.primaries[0] = 0.7f;
    CHECK(firstPixel(read(draft, {ExrContent::normal})) == std::vector<float>{1, 2, 3});
    draft.primaries.assign(8, 0.3f);
    checkRefused(draft, ExrContent::color, "primaries in its header span no colours");
}

TEST_CASE("no words of OpenEXR are in an error") {
    const TemporaryFolder folder;
    ExrDraft draft = with(rgb);
    draft.write(folder / "a.exr");
    const std::string bytes = readText(folder / "a.exr");
    for (size_t length = 0; length < bytes.size(); length += 5) {
        writeText(folder / "b.exr", bytes.substr(0, length));
        const auto image = readExr(folder / "b.exr");
        if (image) continue; // OpenEXR fills rows that are missing at the end
        INFO(image.error().message);
        const bool own =
            image.error().message.ends_with("its header is damaged or cut off, or it is no OpenEXR file") ||
            image.error().message.ends_with("it is not an OpenEXR file") ||
            image.error().message.ends_with("its pixels are damaged or cut off") ||
            image.error().message.ends_with("pixels that its header claims");
        CHECK(own);
    }
}

TEST_CASE("reported files: vectors are compared as vectors, windows as they lie") {
    const char* shared = std::getenv("REBOUND_SHARED");
    const std::filesystem::path reports = std::filesystem::path(shared ? shared : "") / "reports";
    if (!shared || !std::filesystem::exists(reports)) {
        MESSAGE("skipped: REBOUND_SHARED names no folder with reports/");
        return;
    }
    const auto a = readExr(reports / "exr_xyz_channels/nA.exr"),
               b = readExr(reports / "exr_xyz_channels/nB.exr");
    REQUIRE(a);
    REQUIRE(b);
    CHECK(a->channels == 3);
    CHECK(a->data != b->data);
    CHECK_FALSE(readExr(reports / "exr_xyz_channels/depth_Y_and_Z.exr"));
    std::vector<std::string> notes;
    const auto off = readExr(reports / "exr_data_window/off.exr", {ExrContent::any, NAN, &notes});
    REQUIRE(off);
    CHECK(notes.size() == 1);
}
