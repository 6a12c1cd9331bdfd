// SPDX-License-Identifier: MIT
// Text files that the build puts into the program; CMakeLists.txt says which.
#pragma once

#include <string_view>

namespace rebound::charts::embedded {

extern const std::string_view defaultSweep;
extern const std::string_view pageTemplate;
extern const std::string_view pageStyle;
extern const std::string_view pageModel;
extern const std::string_view pageChart;
extern const std::string_view pageScript;
extern const std::string_view chartLibrary; // Chart.js

} // namespace rebound::charts::embedded
