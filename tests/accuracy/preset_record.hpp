// SPDX-License-Identifier: MIT
// Errors of presets held against a record that has to be kept: a change that makes a view worse fails, and so does one
// that makes it better, until the record says so.
#pragma once

#include "reference_frames.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace rebound::accuracy {

class PresetRecord {
public:
    // Of that file: {"scene/camera": {"preset": [relative RMSE, mean over the truth's]}}.
    explicit PresetRecord(const std::filesystem::path&);

    // Measures every preset on the view, and fails the test where one is not as the record says. withBruteForce: also the
    // sum over every texel of a quarter of the resolution, which is what sampling and levels stand in for.
    void check(const ReferenceView&, bool withBruteForce = false);

    // All that check() has measured, as the file would hold it.
    std::string measured() const;

private:
    nlohmann::ordered_json stated, now;
    std::string name; // of the file
};

} // namespace rebound::accuracy
