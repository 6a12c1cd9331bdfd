// SPDX-License-Identifier: MIT
#include "rebound/bake/bake_file.hpp"

#include "lab/temporary_folder.hpp"
#include "rooms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>

using namespace rebound;
using lab::TemporaryFolder;

namespace {

BakeSettings fewest() {
    BakeSettings settings;
    settings.surfels = 20;
    settings.caches = 16;
    settings.links = 4;
    settings.threads = 1;
    return settings;
}

void checkRefused(const std::filesystem::path& path, const std::string& what) {
    const auto bake = readBake(path);
    REQUIRE_MESSAGE(!bake, what, " was taken");
    const std::string& message = bake.error().message;
    CHECK_MESSAGE(message.find(path.string()) != std::string::npos, message);
    CHECK_MESSAGE(message.find('\n') == std::string::npos, message);
}

} // namespace

TEST_CASE("a bake is read as it was written, and mapped memory outlives the file") {
    const TemporaryFolder folder;
    BakeSettings settings = smallSettings();
    for (const LinkForm form : {LinkForm::coefficients, LinkForm::direction}) {
        settings.linkForm = form;
        const Bake written = bakeOf(closedBox(), settings);
        const auto path = folder / "box.bake";
        REQUIRE(writeBake(written, path));
        CHECK(folder.count() == 1);
        auto read = readBake(path);
        REQUIRE_MESSAGE(read, read.error().message);
        std::filesystem::remove(path);
        CHECK(std::memcmp(&read->layout, &written.layout, sizeof(BakeLayout)) == 0);
        for (size_t i = 0; i < size_t(bakeSectionCount); ++i) {
            REQUIRE(read->sections[i].size() == written.sections[i].size());
            CHECK(std::ranges::equal(read->sections[i], written.sections[i]));
            CHECK(reinterpret_cast<uintptr_t>(read->sections[i].data()) % 64 == 0);
        }
        CHECK(validate(*read));
    }
}

TEST_CASE("a file cut short anywhere is refused") {
    const TemporaryFolder folder;
    REQUIRE(writeBake(bakeOf(closedBox(), fewest()), folder / "whole"));
    const std::string whole = lab::readText(folder / "whole");
    REQUIRE(readBake(folder / "whole"));
    size_t cuts = 0;
    for (size_t length = 0; length < whole.size(); length += 97, ++cuts) {
        lab::writeText(folder / "cut", whole.substr(0, length));
        checkRefused(folder / "cut", std::to_string(length) + " bytes");
    }
    lab::writeText(folder / "cut", whole.substr(0, whole.size() - 1));
    checkRefused(folder / "cut", "all but the last byte");
    lab::writeText(folder / "cut", whole + '\0');
    checkRefused(folder / "cut", "a byte too many");
    CHECK(cuts > 50);
}

TEST_CASE("a file altered in any bit is refused") {
    const TemporaryFolder folder;
    REQUIRE(writeBake(bakeOf(closedBox(), fewest()), folder / "whole"));
    const std::string whole = lab::readText(folder / "whole");
    const auto flip = [&](size_t byte, int bit) {
        std::string altered = whole;
        altered[byte] = char(altered[byte] ^ (1 << bit));
        lab::writeText(folder / "altered", altered);
        checkRefused(folder / "altered", "bit " + std::to_string(bit) + " of byte " + std::to_string(byte));
    };
    for (size_t byte = 0; byte < 256; ++byte) flip(byte, int(byte % 8));
    for (size_t byte = 256; byte < whole.size(); byte += whole.size() / 400) flip(byte, int(byte % 8));
    flip(whole.size() - 1, 7);
}

TEST_CASE("what is no bake of this version is refused with what it is") {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& bytes) {
        lab::writeText(folder / "file", bytes);
        const auto bake = readBake(folder / "file");
        REQUIRE(!bake);
        return bake.error().message;
    };
    CHECK(message("").find("is no bake") != std::string::npos);
    CHECK(message("glTF and so on, for long enough").find("is no bake") != std::string::npos);
    REQUIRE(writeBake(bakeOf(closedBox(), fewest()), folder / "whole"));
    std::string next = lab::readText(folder / "whole");
    ++next[24];
    CHECK(message(next).find("version 3; version 2 was expected") != std::string::npos);
    CHECK(!readBake(folder / "absent"));
    CHECK(!readBake(folder.path()));
}

TEST_CASE("what cannot be written is said in one sentence, and nothing is left") {
    const TemporaryFolder folder;
    const Bake bake = bakeOf(closedBox(), fewest());
    const auto failure = writeBake(bake, folder / "absent" / "box.bake");
    REQUIRE(!failure);
    CHECK(failure.error().message.find("absent/box.bake") != std::string::npos);
    CHECK(!writeBake(bake, folder.path()));
    CHECK(!writeBake(bake, ""));
    Bake spoilt = bake;
    spoilt.layout.caches = 0;
    CHECK(!writeBake(spoilt, folder / "spoilt"));
    CHECK(folder.count() == 0);
    if (!std::filesystem::exists("/dev/full")) {
        MESSAGE("skipped: this system has no /dev/full");
        return;
    }
    const auto full = writeBake(bake, "/dev/full");
    REQUIRE(!full);
    CHECK(full.error().message.find("/dev/full: No space left on device") != std::string::npos);
}

TEST_CASE("a file that is written over is whole at any time") {
    const TemporaryFolder folder;
    REQUIRE(writeBake(bakeOf(closedBox(), fewest()), folder / "box.bake"));
    auto first = readBake(folder / "box.bake");
    REQUIRE(first);
    const std::vector<uint32_t> places(first->section(BakeSection::places).begin(),
                                       first->section(BakeSection::places).end());
    REQUIRE(writeBake(bakeOf(twoRooms(0.2f), fewest()), folder / "box.bake"));
    CHECK(folder.count() == 1);
    // The earlier one is still mapped.
    CHECK(std::equal(places.begin(), places.end(), first->section(BakeSection::places).begin()));
}
