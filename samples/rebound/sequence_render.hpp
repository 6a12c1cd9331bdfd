// SPDX-License-Identifier: MIT
// render --frames: a scene in motion, as numbered files and a video.
#pragma once

#include "options.hpp"

#include <optional>
#include <string>

namespace rebound::cli {

inline constexpr const char* sequenceGroup = "Sequence";

// As they were written.
struct SequenceChoice {
    std::optional<int> frames;
    std::optional<std::string> path; // a file; absent: the built-in scene's own path
    std::optional<double> framesPerSecond;

    bool isAsked() const { return frames.has_value(); }
};

void addSequenceOptions(CLI::App&, SequenceChoice&);

// Writes final_0000.png, indirect_0000.exr, motion_0000.exr and so on, timings.json and, with ffmpeg, sequence.mp4, and
// says so on standard output.
Result<> renderSequence(const SourceOptions&, const TechniqueOptions&, const DeviceChoice&,
                        const SequenceChoice&, const std::string& out);

} // namespace rebound::cli
