// SPDX-License-Identifier: MIT
// What conform says, for people, for programs and in pictures.
#pragma once

#include "lab/conformance/conformance.hpp"
#include "report.hpp"

#include <string>
#include <vector>

namespace rebound::cli {

std::string conformText(const conformance::Report&, const std::vector<conformance::Contender>&,
                        const std::vector<std::string>& skipped);
Json conformJson(const conformance::Report&, const std::vector<conformance::Contender>&,
                 const std::vector<std::string>& skipped);

// A sheet for the first disagreement of each backend and kernel: reference, output, difference, difference x 16. Makes
// the folder where there is something to show.
Result<> writeConformPictures(const std::string& folder, const conformance::Report&);

} // namespace rebound::cli
