// SPDX-License-Identifier: MIT
#include "lab/images/image_files.hpp"

#include "temporary_folder.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

using namespace rebound;
using namespace rebound::lab;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

Image rampImage(Extent2D extent, int channels) {
    Image image(extent, channels);
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i) * 0.37f - 5.0f;
    return image;
}

// Equal bits; NaN payloads are free.
bool same(const Image& a, const Image& b) {
    if (a.extent() != b.extent() || a.channels != b.channels) return false;
    for (size_t i = 0; i < a.data.size(); ++i)
        if (!(std::isnan(a.data[i]) && std::isnan(b.data[i])) &&
            std::bit_cast<uint32_t>(a.data[i]) != std::bit_cast<uint32_t>(b.data[i]))
            return false;
    return true;
}

void patch(std::string& bytes, size_t at, int32_t value) {
    REQUIRE(at + sizeof(value) <= bytes.size());
    std::memcpy(bytes.data() + at, &value, sizeof(value));
}

// Where the four integers of a window begin.
size_t windowAt(const std::string& bytes, const std::string& window) {
    const std::string name = window + std::string("\0box2i\0", 7);
    const size_t found = bytes.find(name);
    REQUIRE(found != std::string::npos);
    return found + name.size() + sizeof(int32_t);
}

} // namespace

TEST_CASE("float EXR keeps every bit, NaN and infinities too") {
    const TemporaryFolder folder;
    for (const int channels : {1, 3, 4}) {
        Image image = rampImage({7, 5}, channels);
        image.data[2] = notANumber;
        image.data[3] = -infinity;
        image.data[4] = -0.0f;
        image.data[5] = std::numeric_limits<float>::denorm_min();
        REQUIRE(writeExr(folder / "a.exr", image, ExrPrecision::full));
        const auto read = readExr(folder / "a.exr");
        REQUIRE(read);
        CHECK(same(*read, image));
    }
}

TEST_CASE("half EXR keeps halves, and stores what is beyond as the largest") {
    const TemporaryFolder folder;
    Image image({4, 2}, 1);
    image.data = {0.5f, 65504.0f, 65520.0f, -1e30f, infinity, -infinity, notANumber, 0x1p-24f};
    REQUIRE(writeExr(folder / "a.exr", image));
    Image expected = image;
    expected.data[2] = 65504.0f;
    expected.data[3] = -65504.0f;
    const auto read = readExr(folder / "a.exr");
    REQUIRE(read);
    CHECK(same(*read, expected));
}

TEST_CASE("windows anywhere are mapped to the origin") {
    const TemporaryFolder folder;
    const Image image = rampImage({6, 4}, 3);
    REQUIRE(writeExr(folder / "a.exr", image, ExrPrecision::full));
    std::string bytes = readText(folder / "a.exr");
    const size_t window = windowAt(bytes, "dataWindow"), shown = windowAt(bytes, "displayWindow");
    const int32_t left = -1000000;
    const int32_t top = 70000;
    for (const size_t both : {window, shown}) {
        patch(bytes, both, left);
        patch(bytes, both + 4, top);
        patch(bytes, both + 8, left + 5);
        patch(bytes, both + 12, top + 3);
    }
    // Four rows are one chunk of zip compression: its first field is the row it begins at, and the table of
    // one entry before it holds its place.
    uint64_t place = 0;
    for (size_t at = window; at + 8 <= bytes.size() && place != at + 8; ++at) {
        std::memcpy(&place, bytes.data() + at, sizeof(place));
        if (place == at + 8) patch(bytes, at + 8, top);
    }
    writeText(folder / "b.exr", bytes);
    const auto read = readExr(folder / "b.exr");
    REQUIRE_MESSAGE(read, read.error().message);
    CHECK(same(*read, image));
}

TEST_CASE("absurd sizes are refused before memory is taken") {
    const TemporaryFolder folder;
    REQUIRE(writeExr(folder / "a.exr", rampImage({6, 4}, 3)));
    const std::string bytes = readText(folder / "a.exr");
    const size_t window = windowAt(bytes, "dataWindow");
    for (const int32_t last : {maximumExtent, std::numeric_limits<int32_t>::max(), -2, maximumExtent - 1}) {
        std::string patched = bytes;
        patch(patched, window + 8, last);
        patch(patched, window + 12, last);
        writeText(folder / "b.exr", patched);
        const auto read = readExr(folder / "b.exr");
        REQUIRE(!read);
        CHECK(read.error().code == ErrorCode::invalidData);
        CHECK(read.error().message.find("b.exr") != std::string::npos);
    }
}

TEST_CASE("a truncated EXR is an error at every length") {
    const TemporaryFolder folder;
    REQUIRE(writeExr(folder / "a.exr", rampImage({5, 40}, 3)));
    const std::string bytes = readText(folder / "a.exr");
    for (size_t length = 0; length < bytes.size(); length += 3) {
        writeText(folder / "b.exr", bytes.substr(0, length));
        CHECK_FALSE(readExr(folder / "b.exr"));
    }
}

TEST_CASE("a damaged EXR gives an error or an image of a sound size") {
    const TemporaryFolder folder;
    REQUIRE(writeExr(folder / "a.exr", rampImage({5, 20}, 3)));
    const std::string bytes = readText(folder / "a.exr");
    size_t refused = 0;
    for (size_t at = 0; at < bytes.size(); ++at)
        for (const int flip : {0x01, 0x80, 0xff}) {
            std::string damaged = bytes;
            damaged[at] = char(damaged[at] ^ flip);
            writeText(folder / "b.exr", damaged);
            const auto read = readExr(folder / "b.exr");
            if (!read) {
                ++refused;
                continue;
            }
            REQUIRE(read->data.size() == size_t(read->width) * size_t(read->height) * size_t(read->channels));
            REQUIRE(read->width <= maximumExtent);
        }
    CHECK(refused > bytes.size() / 4); // zip's checksum alone covers the pixels
}

TEST_CASE("what is not a file is named in the error") {
    const TemporaryFolder folder;
    const auto missing = readExr(folder / "missing.exr");
    REQUIRE(!missing);
    CHECK(missing.error().code == ErrorCode::notFound);
    CHECK(missing.error().message.find("missing.exr") != std::string::npos);
    CHECK_FALSE(readExr(folder.path()));
    writeText(folder / "text.exr", "not an image at all");
    const auto text = readExr(folder / "text.exr");
    REQUIRE(!text);
    CHECK(text.error().code == ErrorCode::invalidData);
}

TEST_CASE("images that no EXR can hold are refused and leave the old file") {
    const TemporaryFolder folder;
    writeText(folder / "a.exr", "old");
    Image torn({4, 4}, 3);
    torn.data.pop_back();
    for (const Image& bad : {Image(), Image({2, 2}, 2), torn, Image({maximumExtent + 1, 1}, 1)}) {
        const auto written = writeExr(folder / "a.exr", bad);
        REQUIRE(!written);
        CHECK(written.error().code == ErrorCode::invalidArgument);
    }
    CHECK(readText(folder / "a.exr") == "old");
    CHECK(folder.count() == 1);
}

TEST_CASE("unwritable places are errors and nothing is left behind") {
    const TemporaryFolder folder;
    const Image image = rampImage({4, 4}, 3);
    const Picture picture = toneMap(image, {});
    writeText(folder / "file", "x");
    std::filesystem::create_directory(folder / "folder.exr");
    for (const std::string place : {"no/such/folder.exr", "file/inside.exr", "folder.exr"}) {
        const auto exr = writeExr(folder / place, image);
        REQUIRE(!exr);
        CHECK(exr.error().code == ErrorCode::inputOutput);
        CHECK(exr.error().message.find(place) != std::string::npos);
        CHECK_FALSE(writePng(folder / place, picture));
    }
    CHECK_FALSE(writeExr({}, image));
    CHECK(folder.count() == 2);
    CHECK(std::filesystem::is_empty(folder / "folder.exr"));
}

TEST_CASE("a full device is an error, and stays a device") {
    const std::filesystem::path full = "/dev/full";
    if (!std::filesystem::is_character_file(full)) {
        MESSAGE("skipped: this system has no /dev/full");
        return;
    }
    CHECK_FALSE(writeExr(full, rampImage({4, 4}, 3)));
    CHECK_FALSE(writePng(full, Picture{1, 1, {1, 2, 3}}));
    CHECK(std::filesystem::is_character_file(full));
}

TEST_CASE("a written file replaces the old one, through a link too") {
    const TemporaryFolder folder;
    const Image first = rampImage({4, 4}, 1);
    const Image second = rampImage({2, 3}, 3);
    REQUIRE(writeExr(folder / "a.exr", first, ExrPrecision::full));
    std::filesystem::create_symlink("a.exr", folder / "link.exr");
    REQUIRE(writeExr(folder / "link.exr", second, ExrPrecision::full));
    CHECK(std::filesystem::is_symlink(folder / "link.exr"));
    const auto read = readExr(folder / "a.exr");
    REQUIRE(read);
    CHECK(same(*read, second));
    CHECK(folder.count() == 2);
}
