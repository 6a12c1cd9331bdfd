// SPDX-License-Identifier: MIT
// Finished parts of a bake in files, so that a bake that was interrupted goes on where it was.
#pragma once

#include "rebound/result.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rebound {

struct BakeTask;

// Several processes may use one folder at a time.
class BakePartFolder {
public:
    // identity: tells bakes apart that only differ in what a task's key leaves out (BakeTask). note: called with a
    // sentence about each file that cannot be used, by one thread at a time; empty: nobody is told.
    BakePartFolder(std::filesystem::path folder, std::string identity,
                   std::function<void(const std::string&)> note = {});

    // What the part gave; nothing where there is no file of it, or a damaged one, which is noted. By one thread at a time.
    std::optional<std::vector<uint32_t>> read(const BakeTask&, uint32_t part);
    size_t partsRead() const { return readSoFar; }

    // Makes the folder where it is missing. There is never half a file of a part's name.
    Result<> write(const BakeTask&, uint32_t part, std::span<const uint32_t> numbers) const;

    // Removes files of parts, those of other bakes too and what was left half-written, and the folder, if then nothing is in
    // it.
    void remove() const;

private:
    std::filesystem::path fileOf(const BakeTask&, uint32_t part) const;

    std::filesystem::path folder;
    std::string identity;
    std::function<void(const std::string&)> note;
    size_t readSoFar = 0;
};

} // namespace rebound
