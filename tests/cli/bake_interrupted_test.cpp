// SPDX-License-Identifier: MIT
// Bakes that are killed and started again, by one process and by several.
#include "command_line.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

namespace rebound::cli {
namespace {

namespace fs = std::filesystem;

// Some seconds of one thread, in 32 parts of links.
const std::string longBake =
    "bake builtin:cornell --surfels 2000 --caches 2000 --links 128 --threads 1 --out ";

// A program for mpirun: the command line, but that process `rank` runs `other`.
void writeProgram(const fs::path& file, int rank, const std::string& arguments, const std::string& other) {
    lab::writeText(file, "if [ \"$OMPI_COMM_WORLD_RANK\" = " + std::to_string(rank) + " ]; then\n" + other +
                             "\nfi\nexec \"$REBOUND_CLI\" " + arguments + "\n");
}

// Kills the process that runs this shell's program as soon as a part is finished.
const std::string killWhenPartIsFinished =
    "( until ls killed.bake.parts/*-links-*.part; do sleep 0.01; done > /dev/null 2>&1; kill -9 $$ ) &\n";

// What a shell prints, and how it ends.
Outcome shell(const std::string& command, const fs::path& folder) {
    const test::TestedProgram sh{"REBOUND_SHELL", "sh"};
    return sh.run("-c '" + command + "'", folder);
}

// mpirun on this machine, whatever user and however few cores; empty: there is none.
std::string mpirun(int processes) {
    const char* program = std::getenv("REBOUND_MPIRUN");
    if (program == nullptr) {
        MESSAGE("skipped: the command line was built without MPI");
        return {};
    }
    return "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; " + std::string(program) +
           " --oversubscribe -n " + std::to_string(processes) + " ";
}

size_t finishedParts(const fs::path& folder) {
    size_t parts = 0;
    for (const auto& entry : fs::directory_iterator(folder)) parts += entry.path().extension() == ".part";
    return parts;
}

} // namespace

TEST_CASE("a bake that was killed goes on where it was, to the same file") {
    const lab::TemporaryFolder folder;
    REQUIRE(run(longBake + "whole.bake", folder.path()).exitCode == 0);
    lab::writeText(folder / "killed.sh",
                   killWhenPartIsFinished + "exec \"$REBOUND_CLI\" " + longBake + "killed.bake\n");
    CHECK(shell("sh ./killed.sh", folder.path()).exitCode != 0);
    CHECK(!fs::exists(folder / "killed.bake"));
    REQUIRE(fs::exists(folder / "killed.bake.parts"));
    CHECK(finishedParts(folder / "killed.bake.parts") > 0);
    const Outcome resumed = run(longBake + "killed.bake", folder.path());
    REQUIRE_MESSAGE(resumed.exitCode == 0, resumed.errors);
    CHECK(resumed.output.find("that an earlier run had finished") != std::string::npos);
    CHECK(lab::readText(folder / "killed.bake") == lab::readText(folder / "whole.bake"));
    CHECK(!fs::exists(folder / "killed.bake.parts"));
}

TEST_CASE("one to four processes bake the same file, and one of them speaks") {
    if (mpirun(1).empty()) return;
    const lab::TemporaryFolder folder;
    const std::string bake = "bake builtin:cornell --surfels 600 --caches 600 --links 24 --out ";
    const Outcome alone = run(bake + "one.bake", folder.path());
    REQUIRE_MESSAGE(alone.exitCode == 0, alone.errors);
    for (int processes = 1; processes <= 4; ++processes) {
        const std::string file = std::to_string(processes) + ".bake";
        const Outcome together = shell(mpirun(processes) + "\"$REBOUND_CLI\" " + bake + file, folder.path());
        REQUIRE_MESSAGE(together.exitCode == 0, together.errors);
        CHECK(lab::readText(folder / file) == lab::readText(folder / "one.bake"));
        CHECK(!fs::exists(folder / (file + ".parts")));
        const size_t said = together.output.find("baked in");
        CHECK(said != std::string::npos);
        CHECK(together.output.find("baked in", said + 1) == std::string::npos);
        const std::string by = "by " + std::to_string(processes) + " processes";
        CHECK((together.output.find(by) != std::string::npos) == (processes > 1));
    }
}

TEST_CASE("a process that dies is named, and any number of processes goes on with what was finished") {
    if (mpirun(1).empty()) return;
    const lab::TemporaryFolder folder;
    REQUIRE(run(longBake + "whole.bake", folder.path()).exitCode == 0);
    writeProgram(folder / "dies.sh", 1, longBake + "killed.bake", killWhenPartIsFinished);
    const Outcome killed = shell(mpirun(3) + "sh ./dies.sh", folder.path());
    CHECK(killed.exitCode != 0);
    CHECK_MESSAGE((killed.output + killed.errors).find("rank 1") != std::string::npos, killed.errors);
    CHECK(!fs::exists(folder / "killed.bake"));
    REQUIRE(fs::exists(folder / "killed.bake.parts"));
    CHECK(finishedParts(folder / "killed.bake.parts") > 0);
    const Outcome resumed = shell(mpirun(2) + "\"$REBOUND_CLI\" " + longBake + "killed.bake", folder.path());
    REQUIRE_MESSAGE(resumed.exitCode == 0, resumed.errors);
    CHECK(lab::readText(folder / "killed.bake") == lab::readText(folder / "whole.bake"));
    CHECK(!fs::exists(folder / "killed.bake.parts"));
}

TEST_CASE("what one of several processes cannot do is said once, by its number") {
    if (mpirun(1).empty()) return;
    const lab::TemporaryFolder folder;
    const std::string bake = "bake builtin:cornell --surfels 600 --caches 300 --links 24 --out x.bake";
    const auto saidOf = [&](const std::string& other) {
        writeProgram(folder / "differs.sh", 1, bake, "exec \"$REBOUND_CLI\" " + other);
        const Outcome outcome = shell(mpirun(2) + "sh ./differs.sh", folder.path());
        CHECK(outcome.exitCode == 2);
        CHECK(!fs::exists(folder / "x.bake"));
        const size_t first = outcome.errors.find("rebound: ");
        REQUIRE(first != std::string::npos);
        CHECK(outcome.errors.find("rebound: ", first + 1) == std::string::npos);
        return outcome.errors.substr(first, outcome.errors.find('\n', first) - first);
    };
    CHECK(saidOf("bake absent.gltf --out x.bake").find("process 1 of 2 failed: ") != std::string::npos);
    CHECK(saidOf("bake absent.gltf --out x.bake").find("absent.gltf") != std::string::npos);
    CHECK(saidOf("bake builtin:atrium --surfels 600 --caches 300 --links 24 --out x.bake")
              .find("process 1 of 2 failed: it has prepared another geometry") != std::string::npos);
}

} // namespace rebound::cli
