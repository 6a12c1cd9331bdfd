// SPDX-License-Identifier: MIT
// A run's outputs, all of them or none.
#pragma once

#include "rebound/result.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rebound::cli {

struct OutputFile {
    std::string name;
    std::function<Result<>(const std::filesystem::path&)> write; // writes the file of that path
};

// Of that text.
OutputFile textFile(const std::string& name, std::string text);

// Whether files could be written there now: in an existing folder, or in one that could be created. Leaves no
// trace.
Result<> checkOutputFolder(const std::filesystem::path&);

// Writes the files beside their place and moves them there when all are complete. After a failure the folder
// holds what it held before; a folder that did not exist does not exist then.
Result<> writeOutputFolder(const std::filesystem::path&, const std::vector<OutputFile>&);

} // namespace rebound::cli
