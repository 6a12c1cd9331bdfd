// SPDX-License-Identifier: MIT
// Figures as tables for people and as JSON for programs.
#pragma once

#include "frame_source.hpp"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace rebound::cli {

// As printf has it, up to 511 characters.
template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

// JSON for people and programs, with a line's end; what is no UTF-8, as names of files may be, is replaced.
std::string toText(const Json&);

// What was run on what, in two lines.
std::string describeRun(const SourcedFrame&, const techniques::Configured&, const runner::BackendInfo&,
                        runner::Precision);
// The same for programs: scene or frame, camera, resolution, technique, settings, backend, device, isa, threads,
// precision, memory [bytes].
Json runToJson(const SourcedFrame&, const techniques::Configured&, const runner::BackendInfo&,
               runner::Precision, const MemoryUse&);

// A table with a name and numbers in each row, two decimals; the last row may be set apart.
using TableRow = std::pair<std::string, std::vector<double>>;
enum class LastRow { apart, together };
std::string toTable(const std::vector<std::string>& headings, const std::vector<TableRow>&,
                    LastRow = LastRow::apart);

std::string toText(const MemoryUse&);

} // namespace rebound::cli
