// SPDX-License-Identifier: MIT
// What a chart's folder holds besides pictures.
#pragma once

#include "lab/charts/point.hpp"

#include <filesystem>
#include <string>

namespace rebound::charts {

// A line for each point, after RFC 4180: a field that holds a comma, quotes or a line break stands in quotes.
std::string resultsCsv(const Results&);
std::string csvField(const std::string&);

// The fronts of every view, settings that are never worth their time, and pixels that were not finite; as Markdown,
// which is read as well on a terminal.
std::string summaryText(const Results&);

// One HTML page that needs nothing else; the pictures come from that folder.
Result<std::string> resultsPage(const Results&, const std::filesystem::path& pictures);

// JSON that may stand within <script>: no text in it can end the element or begin a comment.
std::string jsonForScript(const Json&);
std::string base64(std::string_view bytes);

} // namespace rebound::charts
