// SPDX-License-Identifier: MIT
#include "rebound/bake/bake_crew.hpp"

#include "lab/temporary_folder.hpp"
#include "rooms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

using namespace rebound;
using lab::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

BakeSettings roomSettings() {
    BakeSettings settings = smallSettings();
    settings.surfels = 800;
    settings.caches = 900; // in half as many cells: 12 parts and 6
    settings.links = 16;
    return settings;
}

const BakeGeometry& room() {
    static const BakeGeometry geometry = closedBox();
    return geometry;
}

const RayCaster& roomRays() {
    static const auto caster = EmbreeRayCaster::build(room());
    return *caster;
}

const Bake& roomBake() {
    static const Bake bake = bakeOf(room(), roomSettings());
    return bake;
}

Result<std::optional<Bake>> bakeRoom(BakeCrew& crew, const BakeSettings& settings = roomSettings()) {
    return bakeScene(room(), roomRays(), settings, crew);
}

void checkSame(const Result<std::optional<Bake>>& made, const Bake& expected) {
    REQUIRE_MESSAGE(made, made.error().message);
    REQUIRE(made->has_value());
    const Bake& bake = **made;
    CHECK(std::memcmp(&bake.layout, &expected.layout, sizeof(BakeLayout)) == 0);
    for (size_t i = 0; i < size_t(bakeSectionCount); ++i) {
        INFO("section ", name(BakeSection(i)));
        REQUIRE(bake.sections[i].size() == expected.sections[i].size());
        CHECK(std::ranges::equal(bake.sections[i], expected.sections[i]));
    }
}

std::vector<uint32_t> everyNth(uint32_t first, uint32_t step, uint32_t count) {
    std::vector<uint32_t> numbers;
    for (uint32_t i = first; i < count; i += step) numbers.push_back(i);
    return numbers;
}

// So many workers one after the other, each of which does every so many-th part, the last one first.
class ManyWorkers : public BakeCrew {
public:
    explicit ManyWorkers(uint32_t workers) : count(workers) {}
    Result<BakeParts> run(const BakeTask& task, int threads, const BakeProgress& progress) override {
        CHECK(task.parts > 3);
        BakeParts all(task.parts);
        for (uint32_t worker = count; worker-- > 0;) {
            const std::vector<uint32_t> numbers = everyNth(worker, count, task.parts);
            auto done = doBakeParts(task, numbers, threads, nullptr, progress);
            if (!done) return done.error();
            for (size_t i = 0; i < numbers.size(); ++i) all[numbers[i]] = std::move((*done)[i]);
        }
        return all;
    }

private:
    uint32_t count;
};

// Does every other part, keeps them, and is gone.
class Interrupted : public BakeCrew {
public:
    explicit Interrupted(BakePartFolder& folder) : kept(folder) {}
    Result<BakeParts> run(const BakeTask& task, int threads, const BakeProgress& progress) override {
        if (task.name != "links") return LocalBakeCrew(&kept).run(task, threads, progress);
        const std::vector<uint32_t> some = everyNth(0, 2, task.parts);
        REQUIRE(doBakeParts(task, some, threads, &kept, {}));
        return Error{ErrorCode::inputOutput, "interrupted"};
    }

private:
    BakePartFolder& kept;
};

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

// Interrupts a bake, and returns the files of what was finished.
std::vector<fs::path> interruptIn(const fs::path& folder) {
    BakePartFolder kept(folder, "room");
    Interrupted crew(kept);
    REQUIRE(!bakeRoom(crew));
    return filesIn(folder);
}

} // namespace

TEST_CASE("parts that several workers have done make the same bake") {
    for (const uint32_t workers : {1u, 2u, 3u, 4u}) {
        ManyWorkers crew(workers);
        checkSame(bakeRoom(crew), roomBake());
    }
}

TEST_CASE("a crew that returns nothing gets no bake") {
    class Helper : public BakeCrew {
        Result<BakeParts> run(const BakeTask&, int, const BakeProgress&) override { return BakeParts(); }
    } helper;
    const auto none = bakeRoom(helper);
    REQUIRE(none);
    CHECK(!none->has_value());
}

TEST_CASE("an interrupted bake goes on with the parts that were finished") {
    const TemporaryFolder place;
    const std::vector<fs::path> finished = interruptIn(place / "parts");
    CHECK(finished.size() > 5);
    std::vector<std::string> notes;
    BakePartFolder kept(place / "parts", "room", [&](const std::string& note) { notes.push_back(note); });
    LocalBakeCrew crew(&kept);
    checkSame(bakeRoom(crew), roomBake());
    CHECK(kept.partsRead() == finished.size());
    CHECK(notes.empty());
    CHECK(filesIn(place / "parts").size() > finished.size());

    // Once more: all of them are there. Then they are removed, and nothing else is.
    BakePartFolder again(place / "parts", "room");
    LocalBakeCrew last(&again);
    checkSame(bakeRoom(last), roomBake());
    CHECK(again.partsRead() == filesIn(place / "parts").size());
    lab::writeText(place / "parts" / "notes.txt", "mine");
    lab::writeText(place / "parts" / ".rebound-0.partial", "half of a part");
    again.remove();
    CHECK(filesIn(place / "parts") == std::vector<fs::path>{place / "parts" / "notes.txt"});
    fs::remove(place / "parts" / "notes.txt");
    again.remove();
    CHECK(!fs::exists(place / "parts"));
}

TEST_CASE("parts of other bakes are not taken up") {
    const TemporaryFolder place;
    interruptIn(place / "parts");
    BakePartFolder other(place / "parts", "another scene");
    LocalBakeCrew crew(&other);
    checkSame(bakeRoom(crew), roomBake());
    CHECK(other.partsRead() == 0);

    BakePartFolder kept(place / "parts", "room");
    LocalBakeCrew sameScene(&kept);
    BakeSettings settings = roomSettings();
    settings.seed = 3; // surfels elsewhere, and so other links and receivers
    REQUIRE(bakeRoom(sameScene, settings));
    CHECK(kept.partsRead() == 0);
}

TEST_CASE("a damaged part is noted in one sentence and baked again") {
    const auto spoil = [](const std::string& kind, const std::vector<fs::path>& files) {
        const std::string whole = lab::readText(files[0]);
        std::string bytes = whole;
        if (kind == "empty") bytes.clear();
        if (kind == "cut short") bytes.resize(bytes.size() - 1);
        if (kind == "grown") bytes += '\0';
        if (kind == "altered") bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 4);
        if (kind == "another sum") bytes[9] = char(bytes[9] ^ 1);
        if (kind == "another part") bytes = lab::readText(files[1]);
        CHECK(bytes != whole);
        lab::writeText(files[0], bytes);
    };
    for (const char* kind : {"empty", "cut short", "grown", "altered", "another sum", "another part"}) {
        INFO(std::string(kind));
        const TemporaryFolder place;
        const std::vector<fs::path> finished = interruptIn(place / "parts");
        spoil(kind, finished);
        std::vector<std::string> notes;
        BakePartFolder kept(place / "parts", "room", [&](const std::string& note) { notes.push_back(note); });
        LocalBakeCrew crew(&kept);
        checkSame(bakeRoom(crew), roomBake());
        CHECK(kept.partsRead() == finished.size() - 1);
        REQUIRE(notes.size() == 1);
        CHECK(notes[0].find(finished[0].string()) != std::string::npos);
        CHECK(notes[0].find('\n') == std::string::npos);
    }
}

TEST_CASE("where a part cannot be kept the bake ends with one sentence, and no part is half there") {
    const TemporaryFolder place;
    BakePartFolder nowhere(place / "absent" / "parts", "room");
    LocalBakeCrew lost(&nowhere);
    const auto refused = bakeRoom(lost);
    REQUIRE(!refused);
    CHECK(refused.error().message.find("absent/parts") != std::string::npos);
    CHECK(place.count() == 0);

    // As on a full disk: files may grow no further than that.
    BakePartFolder kept(place / "parts", "room");
    LocalBakeCrew crew(&kept);
    const auto bakeWithin = [&](rlim_t bytes) {
        rlimit before{};
        REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
        const auto handler = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit small{bytes, before.rlim_max};
        REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
        auto bake = bakeRoom(crew);
        REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
        std::signal(SIGXFSZ, handler);
        return bake;
    };
    CHECK(!bakeWithin(40));
    CHECK(place.count() == 0);
    const auto full = bakeWithin(10000); // a part of links takes 16 KiB
    REQUIRE(!full);
    CHECK(full.error().message.find("cannot write " + (place / "parts").string()) != std::string::npos);
    CHECK(full.error().message.find('\n') == std::string::npos);
    for (const fs::path& file : filesIn(place / "parts")) CHECK(file.extension() == ".part");
    checkSame(bakeRoom(crew), roomBake());
    CHECK(kept.partsRead() > 0);
}

TEST_CASE("progress of a task goes from what was finished to all") {
    const TemporaryFolder place;
    interruptIn(place / "parts");
    BakePartFolder kept(place / "parts", "room");
    LocalBakeCrew crew(&kept);
    double first = -1.0, last = -1.0;
    BakeSettings settings = roomSettings();
    settings.progress = [&](std::string_view what, double share) {
        if (what != "links") return;
        if (first < 0.0) first = share;
        CHECK(share >= last);
        last = share;
    };
    checkSame(bakeRoom(crew, settings), roomBake());
    CHECK(first > 0.3);
    CHECK(first < 0.9);
    CHECK(last == 1.0);
}
