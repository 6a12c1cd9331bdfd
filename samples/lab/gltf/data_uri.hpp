// SPDX-License-Identifier: MIT
// Data URIs (RFC 2397): files within a file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rebound::lab {

// Whether it begins with "data:", in letters of any size.
bool isDataUri(std::string_view uri);

// The bytes of a data URI of any media type and with any parameters, base64 or percent encoded. `subject` names it in
// errors, which show nothing of the data. Throws InputError.
std::vector<uint8_t> decodeDataUri(std::string_view uri, const std::string& subject);

// Percent encoding undone.
std::string decodePercent(std::string_view text);

} // namespace rebound::lab
